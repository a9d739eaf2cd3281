#include "export/material_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/srgb.h"
#include "map/tangent_moments.h"

namespace redmap {

namespace {

std::uint8_t byte_of(float value) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f))); }

/// value = (coarse + (fine - 128) / 256) / 255.
void split(float value, std::uint8_t& coarse, std::uint8_t& fine) {
  const float steps = 255 * std::clamp(value, 0.f, 1.f);
  coarse = byte_of(value);
  fine = static_cast<std::uint8_t>(std::clamp(128 + std::lround(256 * (steps - static_cast<float>(coarse))), 0l, 255l));
}

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
  Covariance2 covariance;
};
/// All distributions of a texel as one.
TexelNormals normals_of(const ReductionMap& map, int level, int x, int y) {
  if (map.normals.empty() || map.weights.coverage(level, x, y) <= 0) return {};
  const std::size_t bytes = static_cast<std::size_t>(map.normals.texel_bytes(level));
  const std::uint8_t* texel = map.normals.row(level, y).data() + static_cast<std::size_t>(x) * bytes;
  const int count = level == 0 ? 1 : NormalPyramid::kGaussians;
  const std::size_t stride = bytes / static_cast<std::size_t>(count);
  float total = 0;
  Vec2 mean;
  Covariance2 second;
  for (int g = 0; g < count; ++g, texel += stride) {
    PackedNormals packed;
    std::copy_n(texel, packed.bytes.size(), packed.bytes.begin());
    const float share = level == 0 ? 1.0f : static_cast<float>(texel[packed.bytes.size()]);
    const NormalGaussian n = unpack(packed);
    total += share;
    mean = mean + Vec2{n.x, n.y} * share;
    second.xx += share * (n.xx + n.x * n.x), second.yy += share * (n.yy + n.y * n.y);
    second.xy += share * (n.xy + n.x * n.y);
  }
  if (total <= 0) return {};
  mean = mean * (1 / total);
  return {mean,
          {std::max(0.0f, second.xx / total - mean.x * mean.x), second.xy / total - mean.x * mean.y,
           std::max(0.0f, second.yy / total - mean.y * mean.y)}};
}

/// What a mixture of materials is averaged from: all of it linear.
struct Parts {
  Rgb diffuse, passes, reflectance, emission;
  float luminance = 0;                   ///< of the highlights
  SquaredRoughness<double> roughness{};  ///< times that
};
float luminance(Rgb c) { return (c.r + c.g + c.b) / 3; }

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
  const auto part = [](SquaredRoughness<double> squared, float of) {
    const double by = static_cast<double>(of);
    return SquaredRoughness<double>{squared.xx * by, squared.xy * by, squared.yy * by};
  };
  parts.roughness = sum_of(part(squared_roughness(numbers[4], numbers[11], numbers[12]), own),
                           part(squared_roughness(numbers[10], 0.0, 0.0), coat));
  parts.reflectance += Rgb{coat, coat, coat};
  parts.emission = m.emission;
  return parts;
}

void add(const Parts& some, float weight, Parts& sum) {
  sum.diffuse += some.diffuse * weight, sum.passes += some.passes * weight;
  sum.reflectance += some.reflectance * weight, sum.emission += some.emission * weight;
  const double by = static_cast<double>(weight);
  sum.luminance += some.luminance * weight;
  sum.roughness = sum_of(sum.roughness, {some.roughness.xx * by, some.roughness.xy * by, some.roughness.yy * by});
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
  const bool anisotropic =
      std::ranges::any_of(fits, [](const MaterialFit& fit) { return fit.material.anisotropy > 0; });
  if (anisotropic || one.normal) one.anisotropy = make_texture(map, "anisotropy", 3, TexelMeaning::kData);
  return one;
}

/// The mean over the parts, turned with the grain and widened by the normals of the texel.
GltfRoughness roughness_at(const ReductionMap& map, const Parts& sum, int level, int x, int y) {
  const double all = static_cast<double>(std::max(sum.luminance, 1e-6f));
  SquaredRoughness<double> mean{sum.roughness.xx / all, sum.roughness.xy / all, sum.roughness.yy / all};
  if (!map.tangents.empty()) {
    const auto moment = [&](int c) { return static_cast<double>(2 * map.tangents.value(level, x, y, c) - 1); };
    mean = turned(mean, moment(0), moment(1));
  }
  return roughness_of(sum_of(mean, widening_of(normals_of(map, level, x, y).covariance)));
}

void store_texel(const Parts& sum, const GltfRoughness& roughness, OneMaterial& one, int level, int x, int row) {
  const CoreMaterial core = core_of(sum.diffuse + sum.passes, sum.reflectance, kGltfReflectance * one.specular);
  store(core.base_color, one.base_color.levels[level].texel(x, row, 3));
  std::uint8_t* rough = one.metallic_roughness.levels[level].texel(x, row, 3);
  rough[0] = 255;  // glTF keeps occlusion here
  rough[1] = byte_of(roughness.roughness), rough[2] = byte_of(core.metallic);
  if (one.anisotropy) {
    std::uint8_t* to = one.anisotropy->levels[level].texel(x, row, 3);
    to[0] = byte_of(0.5f + 0.5f * std::cos(roughness.rotation));
    to[1] = byte_of(0.5f + 0.5f * std::sin(roughness.rotation));
    to[2] = byte_of(roughness.anisotropy);
  }
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
  const auto texture = [&](const char* name) { return make_texture(map, name, 3, TexelMeaning::kData); };
  NormalTextures all{texture("normal"), texture("normal_fine"), texture("moments"), texture("moments_fine"), 0};
  for (int y = 0; y < map.weights.extent(0).height; ++y)
    for (int x = 0; x < map.weights.extent(0).width; ++x) {
      const TexelNormals normals = normals_of(map, 0, x, y);
      all.scale = std::max({all.scale, normals.covariance.xx + normals.mean.x * normals.mean.x,
                            normals.covariance.yy + normals.mean.y * normals.mean.y});
    }
  all.scale = std::max(all.scale, 1e-6f);
  for_each_texel(map, [&](int level, int x, int y, int row) {
    const auto [mean, covariance] = normals_of(map, level, x, y);
    const Vec3 normal{mean.x, mean.y, std::sqrt(std::max(0.0f, 1 - dot(mean, mean)))};
    const float moments[] = {(covariance.xx + mean.x * mean.x) / all.scale,
                             (covariance.yy + mean.y * mean.y) / all.scale,
                             0.5f + 0.5f * (covariance.xy + mean.x * mean.y) / all.scale};
    for (int c = 0; c < 3; ++c)
      split(0.5f * normal[c] + 0.5f, all.normal.levels[level].texel(x, row, 3)[c],
            all.normal_fine.levels[level].texel(x, row, 3)[c]);
    for (int c = 0; c < 3; ++c)
      split(moments[c], all.moments.levels[level].texel(x, row, 3)[c],
            all.moments_fine.levels[level].texel(x, row, 3)[c]);
  });
  return all;
}

std::optional<Texture> grain_texture(const ReductionMap& map) {
  if (map.tangents.empty()) return std::nullopt;
  Texture grain = make_texture(map, "grain", 3, TexelMeaning::kData);
  for_each_texel(map, [&](int level, int x, int y, int row) {
    for (int c = 0; c < TangentMoments::kCount; ++c)
      grain.levels[level].texel(x, row, 3)[c] = byte_of(map.tangents.value(level, x, y, c));
  });
  return grain;
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
    store_texel(sum, roughness_at(map, sum, level, x, y), one, level, x, row);
  });
  return one;
}

}  // namespace redmap
