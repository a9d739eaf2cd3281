// Rendering frames: which rays a method shoots through a pixel, over tiles, in parallel (paper, section 5).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/image.h"
#include "map/object_data.h"
#include "render/shading.h"
#include "render/tracer.h"
#include "scene/method.h"
#include "scene/scene.h"

namespace redmap {

struct RenderOptions {
  Method method = Method::kMap;
  Quality quality = Quality::kDefault;
  int spp = 0;  ///< supersample: samples, 0 means 16. original: a regular grid of a square number of samples, 0: the
                ///< map's rays
  std::uint64_t seed = 0;
  bool decisions = false;                ///< record how the value of each pixel was found
  bool classify = false;                 ///< supersample only: tell pixels apart by what their samples saw
  std::function<void(double)> progress;  ///< called now and then, from any thread, with the part done
  std::function<bool()> cancelled;       ///< polled between tiles
  /// Shades objects instead of what the method would; empty: nothing does.
  std::function<std::unique_ptr<ObjectShading>(const Object&)> stand_in;
};

/// What the samples of a pixel saw.
enum class PixelClass : std::uint8_t {
  kBackground,  ///< no object
  kInterior,    ///< one object, one chart, continuous depth, the same lights in all
  kSeam,        ///< as interior, but several charts
  kSilhouette,  ///< anything else
};

struct RenderedFrame {
  Image image;  ///< linear RGB
  RenderCounts counts;
  double seconds = 0;
  std::vector<PixelClass> classes;  ///< row-major, if asked for
  std::vector<Decision> decisions;  ///< likewise
};

/// Whether the object's map cannot stand in for its shader, which `method` therefore samples. Method paper brings its
/// own normals, so that it takes shaders whose maps do not reduce for want of these alone.
bool is_supersampled(const Object& object, Method method, const ObjectData& data);

class Renderer {
 public:
  /// `data` has one entry an object. Throws Error if something that the method needs is missing, or was made for
  /// another surface, shader or parameters, and on samples out of range.
  Renderer(const Scene& scene, const RenderOptions& options, const std::vector<ObjectData>& data);

  /// Renders the same objects as they stand in `scene`. `frame` decides the random numbers.
  RenderedFrame render(const Scene& scene, int frame);

 private:
  RenderOptions options_;
  Tracer tracer_;
  std::vector<std::unique_ptr<ObjectShading>> shading_, originals_;
  std::vector<std::uint8_t> supersampled_;  ///< by object: its map does not reduce
  bool transmits_ = false;
};

}  // namespace redmap
