#include "export/material_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/srgb.h"

namespace redmap {

namespace {

std::uint8_t byte_of(float value) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f))); }

Texture make_texture(const ReductionMap& map, const std::string& name, int channels, TexelMeaning meaning) {
  Texture texture{name, channels, 1, meaning, map.weights.wraps_u(), {}};
  for (int level = 0; level < map.weights.levels(); ++level) {
    const Extent extent = map.weights.extent(level);
    texture.levels.push_back(
        {extent, std::vector<std::uint8_t>(static_cast<std::size_t>(extent.width) * extent.height * channels)});
  }
  return texture;
}

/// Calls body(level, x, y, row of the texture) for every texel.
template <typename Body>
void for_each_texel(const ReductionMap& map, const Body& body) {
  for (int level = 0; level < map.weights.levels(); ++level) {
    const Extent extent = map.weights.extent(level);
    parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < extent.width; ++x) body(level, x, y, extent.height - 1 - y);
    });
  }
}

struct TexelNormals {
  Vec2 mean;
  float variance = 0;  ///< of x and y together
};
/// All distributions of a texel as one.
TexelNormals normals_of(const ReductionMap& map, int level, int x, int y) {
  TexelNormals all;
  if (map.normals.empty() || map.weights.coverage(level, x, y) <= 0) return all;
  const std::size_t bytes = static_cast<std::size_t>(map.normals.texel_bytes(level));
  const std::uint8_t* texel = map.normals.row(level, y).data() + static_cast<std::size_t>(x) * bytes;
  const int count = level == 0 ? 1 : NormalPyramid::kGaussians;
  const std::size_t stride = bytes / static_cast<std::size_t>(count);
  float total = 0, second = 0;
  for (int g = 0; g < count; ++g, texel += stride) {
    PackedNormals packed;
    std::copy_n(texel, packed.bytes.size(), packed.bytes.begin());
    const float share = level == 0 ? 1.0f : static_cast<float>(texel[packed.bytes.size()]);
    if (share <= 0) continue;
    const NormalGaussian normals = unpack(packed);
    total += share;
    all.mean = all.mean + Vec2{normals.x, normals.y} * share;
    second += share * (normals.xx + normals.yy + normals.x * normals.x + normals.y * normals.y);
  }
  if (total <= 0) return {};
  all.mean = all.mean * (1 / total);
  all.variance = std::max(0.0f, second / total - dot(all.mean, all.mean));
  return all;
}

/// What a mixture of materials is averaged from: all of it linear.
struct Parts {
  Rgb diffuse, passes, reflectance, emission;
  float luminance = 0, roughness = 0;  ///< of the highlights; and times their squared GGX roughness
};
float luminance(Rgb c) { return (c.r + c.g + c.b) / 3; }
float fourth(float x) { return x * x * x * x; }

Parts parts_of(const GltfMaterial& m) {
  const GltfNumbers<double> numbers = numbers_of(m);
  Parts parts;
  const Rgb base = m.base_color * (1 - m.metallic);
  parts.diffuse = base * (1 - m.transmission), parts.passes = base * m.transmission;
  const auto reflected = [&](int c, float metal) {
    return m.specular * static_cast<float>(numbers[6 + c]) * (1 - m.metallic) + metal * m.metallic;
  };
  parts.reflectance = {reflected(0, m.base_color.r), reflected(1, m.base_color.g), reflected(2, m.base_color.b)};
  const float own = luminance(parts.reflectance), coat = kGltfReflectance * m.coat;
  parts.luminance = own + coat;
  parts.roughness = own * fourth(m.roughness) + coat * fourth(m.coat_roughness);
  parts.reflectance += Rgb{coat, coat, coat};
  parts.emission = m.emission;
  return parts;
}

void add(const Parts& some, float weight, Parts& sum) {
  sum.diffuse += some.diffuse * weight, sum.passes += some.passes * weight;
  sum.reflectance += some.reflectance * weight, sum.emission += some.emission * weight;
  sum.luminance += some.luminance * weight, sum.roughness += some.roughness * weight;
}

/// The metallic part and base colour that reflect and scatter as much at normal incidence.
struct CoreMaterial {
  Rgb base_color;
  float metallic = 0;
};
CoreMaterial core_of(Rgb scatters, Rgb reflectance, float dielectric) {
  // Scattered light is base * (1 - metallic), reflected light dielectric * (1 - metallic) + base * metallic: a
  // quadratic in the metallic part, of the mean colour.
  const float d = luminance(scatters), s = luminance(reflectance);
  CoreMaterial core;
  const float b = d + s - 2 * dielectric, c = dielectric - s;
  const float root = std::sqrt(std::max(0.0f, b * b - 4 * dielectric * c));
  if (s > dielectric) core.metallic = std::clamp((root - b) / (2 * dielectric), 0.0f, 1.0f);
  const float m = core.metallic;
  const auto mixed = [&](float scattered, float reflected) {
    const float of_metal = std::max(0.0f, reflected - dielectric * (1 - m));
    return std::clamp(scattered + of_metal, 0.0f, 1.0f);
  };
  core.base_color = {mixed(scatters.r, reflectance.r), mixed(scatters.g, reflectance.g),
                     mixed(scatters.b, reflectance.b)};
  return core;
}

float largest(Rgb c) { return std::max({c.r, c.g, c.b}); }

void store(Rgb c, std::uint8_t* to) { to[0] = srgb_byte(c.r), to[1] = srgb_byte(c.g), to[2] = srgb_byte(c.b); }

OneMaterial empty_material(const ReductionMap& map, const std::vector<Parts>& parts,
                           const std::vector<MaterialFit>& fits) {
  OneMaterial one;
  one.base_color = make_texture(map, "base_color", 3, TexelMeaning::kColor);
  one.metallic_roughness = make_texture(map, "metallic_roughness", 3, TexelMeaning::kData);
  float emission = 0, passes = 0;
  one.specular = 0;
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const float scale = map.weights.scales()[b];
    emission = std::max(emission, scale * largest(parts[b].emission));
    passes = std::max(passes, largest(parts[b].passes));
    const float own = fits[b].material.metallic > 0.5f ? 1 : luminance(parts[b].reflectance) / kGltfReflectance;
    one.specular = std::max(one.specular, std::min(1.0f, own));
  }
  one.emission_scale = Rgb{1, 1, 1} * emission;
  if (emission > 0) one.emission = make_texture(map, "emission", 3, TexelMeaning::kColor);
  if (passes > 0) one.transmission = make_texture(map, "transmission", 3, TexelMeaning::kData);
  if (auto normals = normal_textures(map)) one.normal = std::move(normals->normal);
  return one;
}

void store_texel(const Parts& sum, float variance, OneMaterial& one, int level, int x, int row) {
  const CoreMaterial core = core_of(sum.diffuse + sum.passes, sum.reflectance, kGltfReflectance * one.specular);
  store(core.base_color, one.base_color.levels[level].texel(x, row, 3));
  const float alpha2 = sum.roughness / std::max(sum.luminance, 1e-6f) + variance;
  std::uint8_t* rough = one.metallic_roughness.levels[level].texel(x, row, 3);
  rough[0] = 255;  // glTF keeps occlusion here
  rough[1] = byte_of(std::pow(alpha2, 0.25f)), rough[2] = byte_of(core.metallic);
  if (one.emission) store(sum.emission * (1 / one.emission_scale.r), one.emission->levels[level].texel(x, row, 3));
  if (one.transmission) {
    const float all = luminance(sum.diffuse + sum.passes);
    std::fill_n(one.transmission->levels[level].texel(x, row, 3), 3,
                byte_of(luminance(sum.passes) / std::max(all, 1e-6f)));
  }
}

}  // namespace

std::uint8_t srgb_byte(float linear) { return byte_of(linear_to_srgb(std::clamp(linear, 0.0f, 1.0f))); }

std::optional<NormalTextures> normal_textures(const ReductionMap& map) {
  if (map.normals.empty()) return std::nullopt;
  NormalTextures all{make_texture(map, "normal", 3, TexelMeaning::kData),
                     make_texture(map, "spread", 1, TexelMeaning::kData)};
  for_each_texel(map, [&](int level, int x, int y, int row) {
    const TexelNormals normals = normals_of(map, level, x, y);
    const Vec2 n = normals.mean;
    const Vec3 normal{n.x, n.y, std::sqrt(std::max(0.0f, 1 - dot(n, n)))};
    std::uint8_t* to = all.normal.levels[level].texel(x, row, 3);
    for (int c = 0; c < 3; ++c) to[c] = byte_of(0.5f * normal[c] + 0.5f);
    *all.spread.levels[level].texel(x, row, 1) = byte_of(std::sqrt(normals.variance));
  });
  return all;
}

Masks mask_textures(const ReductionMap& map) {
  Masks masks;
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    masks.textures.push_back(make_texture(map, fmt::format("mask{:02}", b), 1, TexelMeaning::kData));
    masks.scales.push_back(map.weights.scales()[b]);
  }
  for_each_texel(map, [&](int level, int x, int y, int row) {
    const std::span<const std::uint8_t> texels = map.weights.row(level, y);
    const std::size_t at = static_cast<std::size_t>(x) * map.weights.texel_stride() + 1;  // coverage first
    for (std::size_t b = 0; b < masks.textures.size(); ++b)
      *masks.textures[b].levels[level].texel(x, row, 1) = texels[at + b];
  });
  return masks;
}

OneMaterial average_material(const ReductionMap& map, const std::vector<MaterialFit>& fits) {
  std::vector<Parts> parts;
  for (const MaterialFit& fit : fits) parts.push_back(parts_of(fit.material));
  OneMaterial one = empty_material(map, parts, fits);
  for_each_texel(map, [&](int level, int x, int y, int row) {
    Parts sum;
    for (std::size_t b = 0; b < parts.size(); ++b)
      add(parts[b], map.weights.value(level, x, y, static_cast<int>(b)), sum);
    store_texel(sum, normals_of(map, level, x, y).variance, one, level, x, row);
  });
  return one;
}

}  // namespace redmap
