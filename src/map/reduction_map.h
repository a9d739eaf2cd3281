// The reduction map: a few basis reflectances and, per texel of a pyramid, how much of each (paper, sections 3 to 4.6).
// Pure data: it never calls a shader.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/surface_points.h"
#include "base/vec.h"
#include "lobes/lobe_model.h"
#include "map/certificate.h"
#include "map/footprint.h"
#include "map/normal_pyramid.h"
#include "map/pyramid.h"
#include "map/surface_clusters.h"

namespace redmap {

/// Most basis reflectances a map can have.
inline constexpr int kMaxBasis = 16;

/// A basis reflectance is a place on the surface and the shader run there (paper, section 4.3).
struct BasisPlace {
  Vec3 position, normal, tangent;
  Vec2 uv;
  /// z and x of the frame it is asked in, in the shader's own: others than (0, 0, 1) and (1, 0, 0) where the shader
  /// hides its shading frames (docs/shading_normals.md).
  Vec3 frame_z{0, 0, 1}, frame_x{1, 0, 0};
};

/// What the bake found out about how well the map can stand in for the shader.
enum class MapVerdict {
  kReduces,       ///< the basis represents the shader within the tolerance
  kOneMaterial,   ///< it does, and one averaged material would have been enough
  kDoesNotReduce  ///< it does not: render by supersampling
};

/// A shader of the user's own, so that it can be found again; paths are relative to the map's folder.
struct ShaderOrigin {
  struct ImageFile {
    std::string path;
    bool is_data = false;  ///< numbers, not colours
  };
  std::string file;  ///< empty: a shader of the library
  std::map<std::string, ImageFile> images;
};

struct ReductionMap {
  std::string shader;
  ShaderOrigin shader_origin;
  std::uint64_t shader_hash = 0;  ///< ShaderInfo::text_hash: the version of the shader that was baked
  std::map<std::string, std::vector<float>> parameters;  ///< all of them, by name
  std::uint64_t surface_fingerprint = 0;
  int size = 0;         ///< asked for; the extent of level 0 is weights.extent(0)
  float tolerance = 0;  ///< asked for: maximum residual, RMS over direction samples scaled by their own RMS
  float residual = 0;   ///< reached: the largest residual over all sampled points
  MapVerdict verdict = MapVerdict::kReduces;
  std::string verdict_reason;
  bool hides_frames = false;  ///< normals or tangents are not the shader's word, but were found by probing it
  std::vector<BasisPlace> basis;
  std::vector<LobeModel> lobes;  ///< of each basis reflectance: for integrals over normals (docs/normals.md)
  WeightPyramid weights;
  NormalPyramid normals;     ///< of shading normals; empty where they are the interpolated ones
  WeightPyramid tangents;    ///< TangentMoments of shading frames; empty where they are along the interpolated tangents
  SurfaceClusters clusters;  ///< for footprints that no atlas can serve; empty where the map is one chart
  std::optional<Certificate> certificate;  ///< where it was verified
};

/// Bytes that its texels take in memory.
inline std::size_t texel_bytes(const ReductionMap& map) {
  return map.weights.bytes() + map.normals.bytes() + map.tangents.bytes();
}

/// The places of the basis, to bind the shader at (bind_in_frames()); padding repeats the last.
SurfacePoints basis_points(const ReductionMap& map);
/// The frames to ask it in there; empty where they are the shader's own.
std::vector<Frame> basis_frames(const ReductionMap& map);

}  // namespace redmap
