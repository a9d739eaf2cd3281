// The strongest thing people do today, as a method to be measured against: mip-mapped averaged material parameters,
// gloss widened by the variance of the parameters and by geometric specular antialiasing.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "map/parameter_channels.h"
#include "render/filtered_shading.h"

namespace redmap {

namespace {

// Tokuyoshi and Kaplanyan 2019, "Improved geometric specular antialiasing": kernel variance is clamped at .18. The
// pixel kernel's variance is 1/12, the same box of one (sub-)pixel that the footprint is filtered with, where theirs is
// a Gaussian of .15915.
constexpr float kPixelVariance = 1.0f / 12, kMaximumKernelRoughness = 0.18f;

/// Roughness squared that the turning of the normal within the footprint adds.
float kernel_roughness(const SurfaceHit& hit, const Footprint& footprint) {
  const Vec3 dx = hit.dn_du * footprint.duv_dx.x + hit.dn_dv * footprint.duv_dx.y;
  const Vec3 dy = hit.dn_du * footprint.duv_dy.x + hit.dn_dv * footprint.duv_dy.y;
  return std::min(2 * kPixelVariance * (dot(dx, dx) + dot(dy, dy)), kMaximumKernelRoughness);
}

void set_material(const FilteredTexel& texel, const ShadingBatch& batch, std::size_t i, Materials& materials) {
  const auto& p = texel.channel;
  materials.diffuse.set(
      i, Vec3{p[ParameterChannels::kDiffuse], p[ParameterChannels::kDiffuse + 1], p[ParameterChannels::kDiffuse + 2]});
  materials.specular.set(i, Vec3{p[ParameterChannels::kSpecular], p[ParameterChannels::kSpecular + 1],
                                 p[ParameterChannels::kSpecular + 2]});
  materials.transmittance.set(i, Vec3{p[ParameterChannels::kTransmittance], p[ParameterChannels::kTransmittance + 1],
                                      p[ParameterChannels::kTransmittance + 2]});
  // Phong exponent e and roughness a: a^2 = 2 / (e + 2).
  const float mean =
      2 * p[ParameterChannels::kWeightedRoughness] / std::max(p[ParameterChannels::kSpecularLuminance], 1e-9f);
  const float roughness = mean + kernel_roughness(batch.hits[i], batch.footprints[i]);
  materials.exponent[0][i] = std::clamp(2 / std::max(roughness, 1e-6f) - 2, 0.0f, 1e6f);
}

class ParametersShading : public FilteredShading {
 public:
  ParametersShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const Pyramid<float>> parameters)
      : FilteredShading(std::move(shader), parameters->extent(0)), parameters_(std::move(parameters)) {}

 protected:
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    Materials materials;
    materials.resize(batch.size());
    const auto use = [&](std::size_t i, const FilteredTexel& texel) { set_material(texel, batch, i, materials); };
    for_each_lookup(*parameters_, batch.footprints, LookupFilter::kVarianceMatched, counts, use);
    out.radiance = Planes<3>(batch.size());
    Planes<3> radiance;
    for (std::size_t light = 0; light < batch.lights.size(); ++light) {
      material_radiance_each(materials, pairs_in_frames(batch, light, batch.frames), radiance);
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
  std::shared_ptr<const Pyramid<float>> parameters_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_parameters_shading(std::shared_ptr<const Shader> shader,
                                                       std::shared_ptr<const Pyramid<float>> parameters) {
  if (!shader->info().has_material)
    throw Error("shader '{}' does not declare material(): --method parameters needs it", shader->info().name);
  if (shader->info().perturbs_normals)
    throw Error("shader '{}' declares shading_normal(): --method parameters does not filter normals",
                shader->info().name);
  if (shader->info().emits)
    throw Error("shader '{}' emits light: --method parameters has no parameter for it", shader->info().name);
  return std::make_unique<ParametersShading>(std::move(shader), std::move(parameters));
}

}  // namespace redmap
