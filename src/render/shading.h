// How the hits on one object become radiance: by its shader, by its reduction map, or by a baseline.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "map/footprint.h"
#include "map/pyramid.h"
#include "map/reduction_map.h"
#include "render/decisions.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap {

/// What a frame cost.
struct RenderCounts {
  std::uint64_t camera_rays = 0, shadow_rays = 0;
  std::uint64_t shader_calls = 0;  ///< radiance of a pattern or of a basis reflectance under one light
  std::uint64_t lookups = 0;
  std::uint64_t supersampled_pixels = 0;  ///< where a map does not reduce and the shader itself was sampled
  RenderCounts& operator+=(const RenderCounts& other);
};

/// Hits that are shaded as one (joined_hits.h).
inline constexpr std::size_t kJoined = 4;

/// Hits on one object with all that shading needs, in object space. One entry a hit everywhere.
struct ShadingBatch {
  std::vector<SurfaceHit> hits;       ///< normals turned towards the viewer
  std::vector<std::uint8_t> turned;   ///< whether they had to be
  std::vector<Frame> frames;          ///< shading frames: z the hit's interpolated normal
  std::vector<Footprint> footprints;  ///< of the sample that hit
  std::vector<Vec3> to_viewer;
  /// Of joined hits: the uv of each, on the same side of where the map wraps. The footprint is twice as wide as theirs.
  std::vector<std::array<Vec2, kJoined>> parts;
  struct Light {
    std::vector<Vec3> to_light;
    Planes<3> irradiance;  ///< at normal incidence, shadows included
  };
  std::vector<Light> lights;
  float time = 0;
  bool may_defer = false;  ///< whether a hit may be left without a value, for its pixel to be supersampled

  std::size_t size() const { return hits.size(); }
};

struct ShadedBatch {
  Planes<3> radiance;
  Planes<3> transmittance;          ///< of light from straight behind
  std::vector<Decision> decisions;  ///< one a hit; those supersampled have no value if they may be deferred
};

class ObjectShading {
 public:
  virtual ~ObjectShading() = default;
  virtual void shade(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const = 0;
  /// Whether `footprints` are looked at; where not, they need not be there.
  virtual bool needs_footprints() const = 0;
  /// Whether hits that make up `footprint` together may be shaded as one: close up they may not.
  virtual bool takes_joined(const Footprint&) const { return false; }
  /// Whether joined hits that came to `decision` had better be shaded one by one after all.
  virtual bool takes_apart(Decision) const { return false; }
  /// Only the transmittance, for shadows: `footprints` of the shadow rays where they hit.
  virtual void transmittance(std::span<const SurfaceHit> hits, std::span<const Footprint> footprints, float time,
                             Planes<3>& out) const = 0;
};

/// The shader itself at every hit.
std::unique_ptr<ObjectShading> make_shader_shading(std::shared_ptr<const Shader> shader);

/// The object's reduction map, anisotropic and variance matched, blending into the shader itself over footprints whose
/// major axis is .5 to 1 texel; under that it is the shader, bit for bit. The map has to be
/// of this shader on this surface.
std::unique_ptr<ObjectShading> make_map_shading(std::shared_ptr<const Shader> shader,
                                                std::shared_ptr<const ReductionMap> map,
                                                std::shared_ptr<const Surface> surface);

/// What production does today: mip-mapped averaged material parameters and slopes of shading normals (see
/// bake/baselines.h), lobes widened by their variance and by the curvature in the footprint (Tokuyoshi and Kaplanyan
/// 2019), the same filter and blend. `slopes` only for shaders that perturb normals.
std::unique_ptr<ObjectShading> make_parameters_shading(std::shared_ptr<const Shader> shader,
                                                       std::shared_ptr<const Pyramid<float>> parameters,
                                                       std::shared_ptr<const Pyramid<float>> slopes);

/// The paper's section 5 to the letter: trilinear lookup in the enclosing square, stored mean normal, blend by
/// footprint area over one to two texels. Where `normals` are distributions (bake/baselines.h), footprints that may see
/// a highlight are supersampled (section 5.2).
std::unique_ptr<ObjectShading> make_paper_shading(std::shared_ptr<const Shader> shader,
                                                  std::shared_ptr<const ReductionMap> map,
                                                  std::shared_ptr<const Pyramid<float>> normals);

/// The hits of `batch` at `indices`.
ShadingBatch select(const ShadingBatch& batch, std::span<const std::uint32_t> indices);
/// Radiance and transmittance of those, back to where they came from.
void scatter(const ShadedBatch& from, std::span<const std::uint32_t> indices, ShadedBatch& to);

/// The hits of `batch` as shaders see them: at rest.
SurfacePoints surface_points(const ShadingBatch& batch);

/// The frames that `patterns`, bound to surface_points(batch), are shaded in: about the shader's own normals where it
/// says them, else those of the batch.
std::vector<Frame> shading_frames(const ShadingBatch& batch, const BoundPatterns& patterns);

/// Directions of the hits `batch` towards light `light`, and to the viewer, in `frames`.
DirectionPairs pairs_in_frames(const ShadingBatch& batch, std::size_t light, std::span<const Frame> frames);

/// Adds, hit by hit, weight * radiance * irradiance (weight null: 1).
void add_lit(const float* weight, const Planes<3>& radiance, const Planes<3>& irradiance, Planes<3>& sum);

}  // namespace redmap
