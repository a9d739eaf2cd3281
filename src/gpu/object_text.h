// The texts of the shaders that draw, sort and shade one object. Not part of the public interface.
#pragma once

#include <string>
#include <vector>

#include "device/commands.h"
#include "device/glsl_compiler.h"
#include "user_shader/device_shader.h"

namespace redmap {

enum class SurfaceKind { kMesh, kSphere, kCylinder };

/// What an object's texts depend on.
struct ObjectTraits {
  SurfaceKind surface = SurfaceKind::kMesh;
  bool posed = false;         ///< a deformed mesh
  bool shadows = false;       ///< whether any light casts some
  bool layers = false;        ///< whether any object of the scene lets light pass
  bool passes_light = false;  ///< whether this one does, and there are shadows
  bool is_fast = false;       ///< few normals stand for integrals over wider spreads
  int basis = 0;              ///< 0: no map
  int channels = 0;           ///< of what is looked up: the basis, or averaged parameters; 0: the shader itself
  int first_slope = 0;        ///< channel of the slopes of normals; 0: none
  bool has_coverage = false;  ///< the map's texels have a coverage that is not 1 everywhere
  bool wraps_u = false;
  bool has_normals = false;    ///< the map holds normals
  bool hides_frames = false;   ///< the basis is asked in frames that the shader hides
  bool has_grains = false;     ///< the map holds turns of tangents
  bool draws_normals = false;  ///< no lobe model fits some basis reflectance
  int widths = 1;              ///< most Gaussians of a lobe model
  std::size_t leaves = 0;      ///< of the map's clusters, where they are used
  bool mends_seams = false;    ///< footprints may reach over seams of the map's atlas
  std::vector<int> groups;     ///< of basis reflectances that are mixed before they are asked; empty: none are
};

/// Stages of shading: values of specialization constant 0.
enum class ShadeStage : std::uint32_t { kBind, kNear, kFar, kSpread, kPass, kMix };
inline constexpr int kShadeStages = 6;

std::string draw_text(SurfaceKind surface, GlslStage stage, TargetKind kind);
std::string sort_text(const ObjectTraits& traits);
std::string group_text();
/// Only in layers.
std::string receive_text(const ObjectTraits& traits);
std::string advance_text();
std::string resolve_text(bool layers);

/// `#define REDMAP_...`, which the kernels ask for.
std::string trait_definitions(const ObjectTraits& traits);
/// What a map may hold beside weights and lobe models: normals, grains, clusters, seams. It follows "lobes".
std::string map_parts_text(const ObjectTraits& traits);

/// Of shaders of the user's own every loop asks `kShadeLoopGuard` before each round.
inline constexpr const char* kShadeLoopGuard = "redmap_goes_on";
/// Binds the basis, and finds the groups of its reflectances that mix (ShadeStage::kBind, kMix).
ShaderSources bind_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits);
/// Whether there is anything to find: a pattern that can be mixed, in frames that are the same for all.
bool may_mix(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits);
ShaderSources shade_text(const DeviceShader& shader, const ShaderInfo& info, const ObjectTraits& traits);

}  // namespace redmap
