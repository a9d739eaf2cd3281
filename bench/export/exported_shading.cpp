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
  int size() const { return static_cast<int>(all_.size()); }
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

Covariance2 sum_of(const Covariance2& a, const Covariance2& b) { return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy}; }

/// The covariance of the interpolated normals under a pixel (Tokuyoshi and Kaplanyan 2019, with the box of one pixel).
Covariance2 covariance_of_turning(const SurfaceHit& hit, const Frame& frame, const Footprint& footprint) {
  constexpr float kLargest = 0.18f;  // theirs, of what it adds to squared roughness
  const Vec3 x = frame.to_local(hit.dn_du * footprint.duv_dx.x + hit.dn_dv * footprint.duv_dx.y);
  const Vec3 y = frame.to_local(hit.dn_du * footprint.duv_dy.x + hit.dn_dv * footprint.duv_dy.y);
  const Covariance2 c{(x.x * x.x + y.x * y.x) / 12, (x.x * x.y + y.x * y.y) / 12, (x.y * x.y + y.y * y.y) / 12};
  const float scale = std::min(1.0f, 0.5f * kLargest / std::max({c.xx, c.yy, 1e-12f}));
  return {c.xx * scale, c.xy * scale, c.yy * scale};
}

/// A frame about the normal of a texture, and the covariance of the normals there.
struct TexelFrame {
  Frame frame;
  Covariance2 covariance;
};
/// `mean` and `moments`, coarse and fine, as NormalTextures has them, filtered; `moments` null: not known.
TexelFrame texel_frame(const Frame& surface, bool turned, const float* mean, const float* moments, float scale) {
  const auto with_fine = [](const float* coarse, const float* fine) {
    return *coarse + (fine ? *fine / 256 - 1 / 510.f : 0);
  };
  const float* fine = moments ? moments - 2 : nullptr;
  const float x = 2 * with_fine(mean, fine) - 1, y = 2 * with_fine(mean + 1, fine ? fine + 1 : nullptr) - 1;
  const float sign = turned ? -1.f : 1.f;
  const Vec3 normal = normalized({x, sign * y, std::sqrt(std::max(0.01f, 1 - x * x - y * y))});
  const Frame local = make_frame(normal, {1, 0, 0});
  TexelFrame result{{surface.to_world(local.x), surface.to_world(local.y), surface.to_world(local.z)}, {}};
  if (!moments) return result;
  const auto moment = [&](int c) { return with_fine(moments + c, moments + c + 3); };
  const float xx = std::max(0.0f, scale * moment(0) - x * x), yy = std::max(0.0f, scale * moment(1) - y * y);
  const float largest = std::sqrt(xx * yy);
  const float xy = sign * std::clamp(scale * (2 * moment(2) - 1) - x * y, -largest, largest);
  // Normals about the mean move in the plane across it: z changes by what x and y take away.
  const auto across = [&](Vec3 a) { return Vec2{a.x - a.z * normal.x / normal.z, a.y - a.z * normal.y / normal.z}; };
  const Vec2 a = across(local.x), b = across(local.y);
  const auto between = [&](Vec2 p, Vec2 q) { return p.x * q.x * xx + (p.x * q.y + p.y * q.x) * xy + p.y * q.y * yy; };
  result.covariance = {between(a, a), between(a, b), between(b, b)};
  return result;
}

/// Where the channels of normals begin in a texel, and what they are.
struct NormalChannels {
  int mean = -1, moments = -1;  ///< none; moments are behind the fine part of the mean
  float scale = 1;
};

class ExportedShading : public FilteredShading {
 public:
  ExportedShading(std::shared_ptr<const Shader> shader, Pyramid<float> texels, NormalChannels normals)
      : FilteredShading(std::move(shader), texels.extent(0)), texels_(std::move(texels)), normals_(normals) {}

 protected:
  /// Of a looked-up texel, without what it emits, by lobes widened by `normals`.
  virtual Rgb reflected(const float* texel, const GltfAngles& at, const Covariance2& normals) const = 0;
  virtual Rgb emitted(const float* texel) const = 0;
  virtual Rgb let_through(const float* texel) const = 0;

  float filtered_part(const Footprint&) const override { return 1; }
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    out.radiance = Planes<3>(batch.size()), out.transmittance = Planes<3>(batch.size());
    const auto use = [&](std::size_t i, const FilteredTexel& found) {
      const float* texel = found.channel.data();
      const auto [frame, spread] = frame_of(batch, i, texel);
      const Covariance2 normals =
          sum_of(spread, covariance_of_turning(batch.hits[i], batch.frames[i], batch.footprints[i]));
      Rgb sum = emitted(texel);
      for (const ShadingBatch::Light& light : batch.lights) {
        const GltfAngles at(frame.to_local(light.to_light[i]), frame.to_local(batch.to_viewer[i]));
        if (at.visible()) sum += reflected(texel, at, normals) * light.irradiance.rgb(i);
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
  TexelFrame frame_of(const ShadingBatch& batch, std::size_t i, const float* texel) const {
    if (normals_.mean < 0) return {batch.frames[i], {}};
    const float* moments = normals_.moments < 0 ? nullptr : texel + normals_.moments;
    return texel_frame(batch.frames[i], batch.turned[i] != 0, texel + normals_.mean, moments, normals_.scale);
  }

  Pyramid<float> texels_;
  NormalChannels normals_;
};

Rgb to_rgb(const std::array<double, 3>& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

/// Channels: a weight a material, then normals and grain, where there are any.
class MaskedShading : public ExportedShading {
 public:
  MaskedShading(std::shared_ptr<const Shader> shader, const Channels& channels, const std::vector<MaterialFit>& fits,
                NormalChannels normals, int grain)
      : ExportedShading(std::move(shader), channels.pyramid(), normals), grain_(grain) {
    for (const MaterialFit& fit : fits)
      materials_.push_back(fit.material), numbers_.push_back(numbers_of(fit.material));
  }

 protected:
  Rgb reflected(const float* texel, const GltfAngles& at, const Covariance2& normals) const override {
    Rgb sum;
    for (std::size_t b = 0; b < numbers_.size(); ++b) {
      if (texel[b] <= 0) continue;
      const GltfNumbers<double>& p = numbers_[b];
      SquaredRoughness<double> base = squared_roughness(p[4], p[11], p[12]);
      if (grain_ >= 0) base = turned(base, grain_moment(texel, 0), grain_moment(texel, 1));
      const SquaredRoughness<double> coat = squared_roughness(p[10], 0.0, 0.0), wider = widening_of(normals);
      sum += to_rgb(gltf_radiance(p, sum_of(base, wider), sum_of(coat, wider), at)) * texel[b];
    }
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
  double grain_moment(const float* texel, int c) const { return static_cast<double>(2 * texel[grain_ + c] - 1); }

  std::vector<GltfMaterial> materials_;
  std::vector<GltfNumbers<double>> numbers_;
  int grain_;
};

/// Channels: base colour, metallic, roughness, emission, transmission, anisotropy, and the normal.
class OneMaterialShading : public ExportedShading {
 public:
  OneMaterialShading(std::shared_ptr<const Shader> shader, const Channels& channels, const OneMaterial& one,
                     NormalChannels normals, int anisotropy)
      : ExportedShading(std::move(shader), channels.pyramid(), normals),
        anisotropy_(anisotropy),
        specular_(one.specular),
        emits_(one.emission.has_value()),
        transmits_(one.transmission.has_value()) {}

 protected:
  Rgb reflected(const float* texel, const GltfAngles& at, const Covariance2& normals) const override {
    GltfMaterial material;
    material.base_color = {texel[0], texel[1], texel[2]};
    material.metallic = texel[3], material.roughness = texel[4];
    material.specular = specular_;
    if (transmits_) material.transmission = texel[5 + (emits_ ? 3 : 0)];
    if (anisotropy_ >= 0) {
      const float* anisotropy = texel + anisotropy_;
      material.anisotropy_rotation = std::atan2(2 * anisotropy[1] - 1, 2 * anisotropy[0] - 1);
      material.anisotropy = anisotropy[2];
    }
    const GltfNumbers<double> p = numbers_of(material);
    const SquaredRoughness<double> wider = widening_of(normals);
    return to_rgb(gltf_radiance(p, sum_of(squared_roughness(p[4], p[11], p[12]), wider), wider, at));
  }
  Rgb emitted(const float* texel) const override { return emits_ ? Rgb{texel[5], texel[6], texel[7]} : Rgb{}; }
  Rgb let_through(const float* texel) const override {
    if (!transmits_) return {};
    return Rgb{texel[0], texel[1], texel[2]} * (texel[5 + (emits_ ? 3 : 0)] * (1 - texel[3]));
  }

 private:
  int anisotropy_;
  float specular_;
  bool emits_, transmits_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_masked_shading(std::shared_ptr<const Shader> shader, const Masks& masks,
                                                   const std::vector<MaterialFit>& fits,
                                                   const std::optional<NormalTextures>& normals,
                                                   const std::optional<Texture>& grain) {
  Channels channels;
  for (std::size_t b = 0; b < fits.size(); ++b) channels.add(masks.textures[b], 0, masks.scales[b]);
  NormalChannels at;
  if (normals) {
    at = {channels.size(), channels.size() + 4, normals->scale};
    for (const Texture* texture : {&normals->normal, &normals->normal_fine})
      channels.add(*texture, 0), channels.add(*texture, 1);
    for (int c = 0; c < 3; ++c) channels.add(normals->moments, c);
    for (int c = 0; c < 3; ++c) channels.add(normals->moments_fine, c);
  }
  const int grain_at = grain ? channels.size() : -1;
  if (grain) channels.add(*grain, 0), channels.add(*grain, 1);
  return std::make_unique<MaskedShading>(std::move(shader), channels, fits, at, grain_at);
}

std::unique_ptr<ObjectShading> make_one_material_shading(std::shared_ptr<const Shader> shader, const OneMaterial& one) {
  Channels channels;
  for (int c = 0; c < 3; ++c) channels.add(one.base_color, c);
  channels.add(one.metallic_roughness, 2), channels.add(one.metallic_roughness, 1);
  if (one.emission)
    for (int c = 0; c < 3; ++c) channels.add(*one.emission, c, one.emission_scale.r);
  if (one.transmission) channels.add(*one.transmission, 0);
  const int anisotropy = one.anisotropy ? channels.size() : -1;
  if (one.anisotropy)
    for (int c = 0; c < 3; ++c) channels.add(*one.anisotropy, c);
  NormalChannels at;
  if (one.normal) {
    at.mean = channels.size();
    channels.add(*one.normal, 0), channels.add(*one.normal, 1);
  }
  return std::make_unique<OneMaterialShading>(std::move(shader), channels, one, at, anisotropy);
}

}  // namespace redmap::bench
