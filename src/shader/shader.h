// What every procedural shader looks like from outside: a black box that is bound to places and asked for radiance.
//
// Directions are unit vectors that point away from the surface, in the shading frame of the place (z = shading normal,
// x = tangent). Radiance is what leaves towards the viewer under a point light of unit irradiance at normal incidence,
// cosine included: a white Lambert surface has cos / pi. Always batches, never a virtual call per pair.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/surface_points.h"
#include "base/vec.h"
#include "shader/parameters.h"

namespace redmap {

/// Direction pairs, one array a coordinate, padded to whole lanes.
struct DirectionPairs {
  Planes<3> to_light, to_viewer;
  std::size_t size() const { return to_light.size(); }
  void resize(std::size_t size) { to_light.resize(size), to_viewer.resize(size); }
};

/// What a production pipeline would export of a place, for shaders that can say it: the prelude's `Material`. Used by
/// the `parameters` baseline only; baking and rendering a reduction map never ask.
struct Materials {
  Planes<3> diffuse, specular, transmittance;
  Planes<1> exponent, ggx, grazing;
  Planes<3> roughness;  ///< squared, of the GGX lobe: xx, xy, yy over the shading frame
  Planes<3> normals;    ///< covariance of the normals about the shading normal, likewise; shaders leave it nil
  void resize(std::size_t size) {
    diffuse.resize(size), specular.resize(size), transmittance.resize(size), roughness.resize(size);
    exponent.resize(size), ggx.resize(size), grazing.resize(size), normals.resize(size);
  }
};

/// A shader's patterns at some places: evaluated once, stored, never run again. Immutable and safe to share.
/// Outputs have `stride` >= padded(count) and may hold anything in the padding.
class BoundPatterns {
 public:
  virtual ~BoundPatterns() = default;
  virtual std::size_t size() const = 0;

  /// Pattern i under pair i, for every i. `out` is resized to size().
  virtual void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const = 0;
  /// Pattern `pattern` under every pair. `out` is resized to pairs.size().
  virtual void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const = 0;
  /// Every pattern under every pair: out[(pair * 3 + channel) * padded(size()) + pattern], resized to fit.
  virtual void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const = 0;

  /// Part of the light from behind that passes straight through, 0 to 1; zero for opaque shaders.
  virtual void transmittance(Planes<3>& out) const = 0;
  /// Light of its own, the same in all directions; zero for most shaders.
  virtual void emission(Planes<3>& out) const = 0;
  /// False, and `out` untouched, if the shader does not say.
  virtual bool materials(Materials& out) const = 0;
  /// Shading normals, object space, unit. False, and `out` untouched, if the shader does not say: then they are the
  /// interpolated normals of the places, or whatever a black box hides (analysis/shading_normal.h).
  virtual bool shading_normals([[maybe_unused]] Planes<3>& out) const { return false; }
  /// What the x of the shading frames leans to, object space, unit: of use where a reflectance is anisotropic and its
  /// grain turns from place to place. False, and `out` untouched, if the shader does not say: then they are the
  /// tangents of the places.
  virtual bool shading_tangents([[maybe_unused]] Planes<3>& out) const { return false; }
};

/// A picture that a shader samples, declared as `uniform sampler2D wood;  // MEANING`.
struct ShaderImageInfo {
  std::string name, meaning;
  std::filesystem::path file;  ///< that it is; empty where only the declaration is known
  bool is_data = false;        ///< numbers, not colours
};

/// What is known of a shader without running it, read from its own text.
struct ShaderInfo {
  std::string name;
  std::string summary;          ///< the first comment line of the text
  std::uint64_t text_hash = 0;  ///< of the complete text, includes and images too: tells versions of a shader apart
  std::vector<ParameterInfo> parameters;
  std::filesystem::path file;           ///< of shaders of the user's own; empty for the library's
  std::vector<ShaderImageInfo> images;  ///< none in the library
  bool black_box = false;               ///< radiance(Surface, ...) instead of the split form
  bool transmits = false;               ///< declares transmittance()
  bool emits = false;                   ///< declares emission()
  bool has_material = false;            ///< declares material(), for the `parameters` baseline
  bool varies_in_time = false;          ///< its text reads Surface.time: no map can stand in for it
  bool perturbs_normals = false;        ///< declares shading_normal(): BoundPatterns::shading_normals() answers
  bool turns_tangents = false;          ///< declares shading_tangent(): BoundPatterns::shading_tangents() answers
};

/// bind() and what it returns throw Error only for shaders of the user's own, which may fail while they run.
class Shader {
 public:
  virtual ~Shader() = default;
  virtual const ShaderInfo& info() const = 0;
  /// The parameters in force, in the order of info().parameters.
  virtual const ParameterValues& parameters() const = 0;
  /// The patterns at `points`. Padding points are evaluated too and must be harmless.
  virtual std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const = 0;
};

/// Names of the library's shaders, in the order they are listed to people.
std::vector<std::string> library_shader_names();
/// Throws Error naming the nearest library shader if there is none of that name.
const ShaderInfo& library_shader_info(std::string_view name);
/// A library shader with some of its parameters set; the others keep their defaults. Throws Error on an unknown
/// shader or parameter (naming the nearest), a wrong type or a value out of range.
std::shared_ptr<const Shader> make_library_shader(std::string_view name, const ParameterOverrides& overrides = {});

/// The reflectance that `Materials` are parameters of, as the library's shaders evaluate it, over normals that vary by
/// `normals` (include/widened.glsl). Material i under pair i. `out` is resized.
void material_radiance_each(const Materials& materials, const DirectionPairs& pairs, Planes<3>& out);

}  // namespace redmap
