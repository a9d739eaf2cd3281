// The strongest thing people do today, as a method to be measured against: mip-mapped averaged material parameters,
// lobes widened by the variance of the parameters, by that of the shading normals (Olano and Baker 2010) and by
// geometric specular antialiasing.
#include <algorithm>
#include <cmath>

#include "map/slope_moments.h"
#include "render/filtered_shading.h"
#include "shader/material_channels.h"

namespace redmap {

namespace {

// Tokuyoshi and Kaplanyan 2019, "Improved geometric specular antialiasing": kernel variance is clamped at .18. The
// pixel kernel's variance is 1/12, the same box of one (sub-)pixel that the footprint is filtered with, where theirs is
// a Gaussian of .15915.
constexpr float kPixelVariance = 1.0f / 12, kMaximumKernelRoughness = 0.18f;

/// What the turning of the interpolated normal within the footprint adds to the covariance of normals over x and y of
/// `frame`. Roughness squared is twice the variance.
Covariance2 kernel_covariance(const SurfaceHit& hit, const Footprint& footprint, const Frame& frame) {
  const Vec3 dx = hit.dn_du * footprint.duv_dx.x + hit.dn_dv * footprint.duv_dx.y;
  const Vec3 dy = hit.dn_du * footprint.duv_dy.x + hit.dn_dv * footprint.duv_dy.y;
  const Vec2 x{dot(frame.x, dx), dot(frame.x, dy)}, y{dot(frame.y, dx), dot(frame.y, dy)};
  const float roughness = 2 * kPixelVariance * (dot(x, x) + dot(y, y));
  const float part = kPixelVariance * std::min(1.0f, kMaximumKernelRoughness / std::max(roughness, 1e-9f));
  return {part * dot(x, x), part * dot(x, y), part * dot(y, y)};
}

void set_covariance(Covariance2 a, Covariance2 b, std::size_t i, Materials& materials) {
  materials.normals.set(i, Vec3{a.xx + b.xx, a.xy + b.xy, a.yy + b.yy});
}

class ParametersShading : public FilteredShading {
 public:
  ParametersShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const Pyramid<float>> parameters,
                    std::shared_ptr<const Pyramid<float>> slopes)
      : FilteredShading(std::move(shader), parameters->extent(0)),
        parameters_(std::move(parameters)),
        slopes_(std::move(slopes)) {}

 protected:
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    Materials materials;
    materials.resize(batch.size());
    for_each_lookup(
        *parameters_, batch.footprints, LookupFilter::kVarianceMatched, counts,
        [&](std::size_t i, const FilteredTexel& texel) { set_material(texel.channel.data(), i, materials); });
    const std::vector<Frame> frames = slopes_ ? mean_frames(batch, materials, counts) : batch.frames;
    if (!slopes_)
      for (std::size_t i = 0; i < batch.size(); ++i)
        set_covariance({}, kernel_covariance(batch.hits[i], batch.footprints[i], frames[i]), i, materials);

    out.radiance = Planes<3>(batch.size());
    Planes<3> radiance;
    for (std::size_t light = 0; light < batch.lights.size(); ++light) {
      material_radiance_each(materials, pairs_in_frames(batch, light, frames), radiance);
      add_lit(nullptr, radiance, batch.lights[light].irradiance, out.radiance);
    }
    counts.shader_calls += batch.size() * batch.lights.size();
    out.transmittance = materials.transmittance;
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    const auto& p = parameters_->lookup(footprint, LookupFilter::kVarianceMatched).channel;
    return {p[ParameterChannels::kTransmittance], p[ParameterChannels::kTransmittance + 1],
            p[ParameterChannels::kTransmittance + 2]};
  }

 private:
  /// Shading frames about the mean normals under the footprints, and the covariance of the normals in them.
  std::vector<Frame> mean_frames(const ShadingBatch& batch, Materials& materials, RenderCounts& counts) const {
    std::vector<Frame> frames(batch.size());
    const auto use = [&](std::size_t i, const FilteredTexel& texel) {
      NormalsOfSlopes normals = normals_of_slopes(texel.channel.data());
      // Seen from behind, the frame's y looks the other way.
      if (batch.turned[i]) normals.mean.y = -normals.mean.y, normals.covariance.xy = -normals.covariance.xy;
      const Frame& surface = batch.frames[i];
      const Frame mean = make_frame(normals.mean, {1, 0, 0});
      frames[i] = {surface.to_world(mean.x), surface.to_world(mean.y), surface.to_world(mean.z)};
      set_covariance(covariance_in_frame(normals, mean),
                     kernel_covariance(batch.hits[i], batch.footprints[i], frames[i]), i, materials);
    };
    for_each_lookup(*slopes_, batch.footprints, LookupFilter::kVarianceMatched, counts, use);
    return frames;
  }

  std::shared_ptr<const Pyramid<float>> parameters_, slopes_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_parameters_shading(std::shared_ptr<const Shader> shader,
                                                       std::shared_ptr<const Pyramid<float>> parameters,
                                                       std::shared_ptr<const Pyramid<float>> slopes) {
  return std::make_unique<ParametersShading>(std::move(shader), std::move(parameters), std::move(slopes));
}

}  // namespace redmap
