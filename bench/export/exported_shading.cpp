#include "exported_shading.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "render/filtered_shading.h"

namespace redmap::bench {

namespace {

/// Channels of textures of the same extents as floats, their levels as they are.
class Channels {
 public:
  void add(const Texture& texture, int channel, float scale = 1) { all_.push_back({&texture, channel, scale}); }
  Pyramid<float> pyramid() const;

 private:
  struct Channel {
    const Texture* texture;
    int channel;
    float scale;
  };
  static float value(const Channel& c, const TextureLevel& level, int x, int row) {
    const float stored = static_cast<float>(level.texel(x, row, c.texture->channels)[c.channel]) / 255;
    return c.scale * (c.texture->meaning == TexelMeaning::kColor ? srgb_to_linear(stored) : stored);
  }
  std::vector<Channel> all_;
};

Pyramid<float> Channels::pyramid() const {
  const Texture& first = *all_.front().texture;
  const std::vector<float> ones(all_.size(), 1.0f);
  Pyramid<float> pyramid(first.levels.front().extent, static_cast<int>(all_.size()), first.wraps_u, ones);
  for (int level = 0; level < pyramid.levels(); ++level)
    for (int y = 0; y < pyramid.extent(level).height; ++y) {
      const std::span<float> row = pyramid.row(level, y);
      for (int x = 0; x < pyramid.extent(level).width; ++x) {
        float* texel = &row[static_cast<std::size_t>(x) * pyramid.texel_stride()];
        texel[0] = 1;  // engines know no coverage
        for (std::size_t c = 0; c < all_.size(); ++c)
          texel[1 + c] = value(all_[c], all_[c].texture->levels[level], x, pyramid.extent(level).height - 1 - y);
      }
    }
  pyramid.pad_rows();
  return pyramid;
}

/// What the turning of the interpolated normal under a pixel adds to squared roughness (Tokuyoshi and Kaplanyan 2019,
/// with the box of one pixel; both axes alike).
double kernel_widening(const SurfaceHit& hit, const Footprint& footprint) {
  constexpr float kLargest = 0.18f;  // theirs
  const Vec3 x = hit.dn_du * footprint.duv_dx.x + hit.dn_dv * footprint.duv_dx.y;
  const Vec3 y = hit.dn_du * footprint.duv_dy.x + hit.dn_dv * footprint.duv_dy.y;
  return static_cast<double>(std::min(kLargest, (dot(x, x) + dot(y, y)) / 12));
}

class ExportedShading : public FilteredShading {
 public:
  ExportedShading(std::shared_ptr<const Shader> shader, Pyramid<float> texels, bool has_normals)
      : FilteredShading(std::move(shader), texels.extent(0)), texels_(std::move(texels)), has_normals_(has_normals) {}

 protected:
  /// Of a looked-up texel, without what it emits.
  virtual Rgb reflected(const float* texel, const GltfAngles& at, double widening) const = 0;
  virtual Rgb emitted(const float* texel) const = 0;
  virtual Rgb let_through(const float* texel) const = 0;

  float filtered_part(const Footprint&) const override { return 1; }
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    out.radiance = Planes<3>(batch.size()), out.transmittance = Planes<3>(batch.size());
    const auto use = [&](std::size_t i, const FilteredTexel& found) {
      const float* texel = found.channel.data();
      const Frame frame = frame_of(batch, i, texel);
      const double widening = kernel_widening(batch.hits[i], batch.footprints[i]);
      Rgb sum = emitted(texel);
      for (const ShadingBatch::Light& light : batch.lights) {
        const GltfAngles at(frame.to_local(light.to_light[i]), frame.to_local(batch.to_viewer[i]));
        if (at.visible()) sum += reflected(texel, at, widening) * light.irradiance.rgb(i);
      }
      out.radiance.set(i, Vec3{sum.r, sum.g, sum.b});
      const Rgb passes = let_through(texel);
      out.transmittance.set(i, Vec3{passes.r, passes.g, passes.b});
    };
    for_each_lookup(texels_, batch.footprints, LookupFilter::kVarianceMatched, counts, use);
  }
  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return let_through(texels_.lookup(footprint).channel.data());
  }

 private:
  /// The last two channels are the mean normal, if there are any of it.
  Frame frame_of(const ShadingBatch& batch, std::size_t i, const float* texel) const {
    const Frame& surface = batch.frames[i];
    if (!has_normals_) return surface;
    const float* n = texel + texels_.channels() - 2;
    const float x = 2 * n[0] - 1, y = (batch.turned[i] ? -1.f : 1.f) * (2 * n[1] - 1);
    const Frame mean = make_frame(normalized({x, y, std::sqrt(std::max(0.01f, 1 - x * x - y * y))}), {1, 0, 0});
    return {surface.to_world(mean.x), surface.to_world(mean.y), surface.to_world(mean.z)};
  }

  Pyramid<float> texels_;
  bool has_normals_;
};

Rgb to_rgb(const std::array<double, 3>& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

/// Channels: a weight a material, then the spread and the normal.
class MaskedShading : public ExportedShading {
 public:
  MaskedShading(std::shared_ptr<const Shader> shader, const Channels& channels, const std::vector<MaterialFit>& fits,
                bool has_normals)
      : ExportedShading(std::move(shader), channels.pyramid(), has_normals), has_spread_(has_normals) {
    for (const MaterialFit& fit : fits)
      materials_.push_back(fit.material), numbers_.push_back(numbers_of(fit.material));
  }

 protected:
  Rgb reflected(const float* texel, const GltfAngles& at, double widening) const override {
    if (has_spread_) widening += static_cast<double>(texel[numbers_.size()] * texel[numbers_.size()]);
    Rgb sum;
    for (std::size_t b = 0; b < numbers_.size(); ++b)
      if (texel[b] > 0) sum += to_rgb(gltf_radiance(numbers_[b], at, widening)) * texel[b];
    return sum;
  }
  Rgb emitted(const float* texel) const override {
    Rgb sum;
    for (std::size_t b = 0; b < materials_.size(); ++b) sum += materials_[b].emission * texel[b];
    return sum;
  }
  Rgb let_through(const float* texel) const override {
    Rgb sum;
    for (std::size_t b = 0; b < materials_.size(); ++b)
      sum += materials_[b].base_color * (materials_[b].transmission * texel[b]);
    return sum;
  }

 private:
  std::vector<GltfMaterial> materials_;
  std::vector<GltfNumbers<double>> numbers_;
  bool has_spread_;
};

/// Channels: base colour, metallic, roughness, emission, transmission, and the normal.
class OneMaterialShading : public ExportedShading {
 public:
  OneMaterialShading(std::shared_ptr<const Shader> shader, const Channels& channels, const OneMaterial& one)
      : ExportedShading(std::move(shader), channels.pyramid(), one.normal.has_value()),
        specular_(one.specular),
        emits_(one.emission.has_value()),
        transmits_(one.transmission.has_value()) {}

 protected:
  Rgb reflected(const float* texel, const GltfAngles& at, double widening) const override {
    GltfMaterial material;
    material.base_color = {texel[0], texel[1], texel[2]};
    material.metallic = texel[3], material.roughness = std::max(texel[4], 0.0525f);  // as three.js clamps it
    material.specular = specular_;
    if (transmits_) material.transmission = texel[5 + (emits_ ? 3 : 0)];
    return to_rgb(gltf_radiance(numbers_of(material), at, widening));
  }
  Rgb emitted(const float* texel) const override { return emits_ ? Rgb{texel[5], texel[6], texel[7]} : Rgb{}; }
  Rgb let_through(const float* texel) const override {
    if (!transmits_) return {};
    return Rgb{texel[0], texel[1], texel[2]} * (texel[5 + (emits_ ? 3 : 0)] * (1 - texel[3]));
  }

 private:
  float specular_;
  bool emits_, transmits_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_masked_shading(std::shared_ptr<const Shader> shader, const Masks& masks,
                                                   const std::vector<MaterialFit>& fits,
                                                   const std::optional<NormalTextures>& normals) {
  Channels channels;
  for (std::size_t b = 0; b < fits.size(); ++b) channels.add(masks.textures[b], 0, masks.scales[b]);
  if (normals) channels.add(normals->spread, 0), channels.add(normals->normal, 0), channels.add(normals->normal, 1);
  return std::make_unique<MaskedShading>(std::move(shader), channels, fits, normals.has_value());
}

std::unique_ptr<ObjectShading> make_one_material_shading(std::shared_ptr<const Shader> shader, const OneMaterial& one) {
  Channels channels;
  for (int c = 0; c < 3; ++c) channels.add(one.base_color, c);
  channels.add(one.metallic_roughness, 2), channels.add(one.metallic_roughness, 1);
  if (one.emission)
    for (int c = 0; c < 3; ++c) channels.add(*one.emission, c, one.emission_scale.r);
  if (one.transmission) channels.add(*one.transmission, 0);
  if (one.normal) channels.add(*one.normal, 0), channels.add(*one.normal, 1);
  return std::make_unique<OneMaterialShading>(std::move(shader), channels, one);
}

}  // namespace redmap::bench
