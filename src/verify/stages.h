// Where the error of a map comes from: the stages between shader and pixel, each replaced by the truth. A pixel is
// rendered from the same rays five times over, and every time one stage more is the map's own.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "analysis/basis.h"
#include "analysis/sampling.h"
#include "render/basis_shading.h"
#include "verify/pixel_renderer.h"

namespace redmap {

/// What the map does to a pixel, in the order of its making.
enum class Stage {
  kFit,     ///< mixtures of the basis in place of the reflectance itself, at every place
  kTexels,  ///< the weights of the texel in place of those of the place: its width, its samples, its bytes
  kFilter,  ///< the weights that were looked up in place of the average of those under the pixel
  kNormals  ///< a few normals and directions, apart from the weights, in place of those of every place
};
inline constexpr int kStages = 4;
inline constexpr std::string_view kStageNames[kStages] = {"fit", "texels", "filter", "normals"};

/// Signed contributions to the error of a pixel; they add up to it, noise of the truth apart.
using StageErrors = std::array<Rgb, kStages>;

/// Takes pixels of one map apart.
class StageMeter {
 public:
  /// `places`: some points of the surface, for the scales of reflectance samples. The map has to be of this object.
  StageMeter(const Object& object, std::shared_ptr<const ReductionMap> map, const SurfacePoints& places);
  ~StageMeter();

  /// Of a pixel that no ray sees close up: `frame` is what the map came to, `truth` what `spp` samples of `seed` did.
  StageErrors measure(const PixelRenderer& renderer, const PixelCase& pixel, Quality quality, Rgb frame, Rgb truth,
                      int spp, std::uint64_t seed) const;

 private:
  struct Probe;
  std::vector<float> looked_up(const PixelRenderer& renderer, const PixelCase& pixel, Quality quality) const;
  std::vector<float> under_pixel(const PixelRenderer& renderer, const PixelCase& pixel, int spp,
                                 std::uint64_t seed) const;

  std::shared_ptr<const ReductionMap> map_;
  std::shared_ptr<const Shader> own_;     ///< the object's
  std::shared_ptr<const Shader> shader_;  ///< the same, as if it said what it hides of its frames
  std::shared_ptr<const BasisShading> basis_;
  std::unique_ptr<ObjectShading> fitted_, texels_;
  std::vector<Probe> probes_;  ///< three weights each
};

}  // namespace redmap
