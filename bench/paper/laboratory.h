// What the figures share: the paper's textures with what it says about them, surfaces and maps that are made once, the
// methods that are compared, and sequences of frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bake/bake.h"
#include "paper.h"
#include "render/renderer.h"
#include "scene/scene.h"

namespace redmap::bench {

/// What the bumps of the bumpy bunny are here: fractal noise whose root mean square slope is this (normals/cases.h).
inline constexpr const char *kBump = "fbm.08", *kBumpGloss = "phong100";

/// A texture of the paper: its own figures, and what stands in for it here.
struct PaperTexture {
  std::string name;     ///< as in Fig. 5
  std::string object;   ///< as in make_bench_surface(); griffin and igea are not public, the bunny has as many
                        ///< triangles
  std::string shader;   ///< of the library, or kBump
  int paper_basis = 0;  ///< Fig. 5
  double paper_megabytes = 0;
  double paper_calls_map = 0, paper_calls_16 = 0;                                 ///< Fig. 8, a frame; 0: not in it
  double paper_seconds_1 = 0, paper_seconds_16 = 0, paper_seconds_map = 0;        ///< Fig. 8, 300 frames
  double paper_sampling = 0, paper_nnls = 0, paper_filling = 0, paper_total = 0;  ///< Fig. 10, seconds
};
/// In the order of Fig. 5.
const std::vector<PaperTexture>& paper_textures();

/// A shader on a surface, baked, with what the other methods need.
struct BakedTexture {
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const Shader> shader;
  std::vector<ObjectData> data;  ///< one
  BakeReport report;
  const ReductionMap& map() const { return *data.front().map; }
};

class Laboratory {
 public:
  explicit Laboratory(const PaperOptions& options) : options_(options) {}
  const PaperOptions& options() const { return options_; }
  bool quick() const { return options_.quick; }
  /// `full`, or `quick` where that was asked for.
  int samples(int full, int quick) const { return options_.quick ? quick : full; }

  std::shared_ptr<const Surface> surface(const std::string& object);
  std::shared_ptr<const Shader> shader(const std::string& object, const std::string& name);
  /// Baked at the first call, and kept as long as it is among the last few.
  BakedTexture baked(const std::string& object, const std::string& shader);

  /// Figure `index` of `count` begins.
  void begin(const std::string& what, std::size_t index, std::size_t count);
  /// That part of it is done. Throws Error if the bench was cancelled.
  void step(double part_of_figure);

 private:
  const PaperOptions& options_;
  std::map<std::string, std::shared_ptr<const Surface>> surfaces_;
  struct Kept {
    std::string object, shader;
    BakedTexture texture;
  };
  std::list<Kept> baked_;  ///< the last used first
  std::string what_;
  double first_ = 0, width_ = 1;
};

/// A way to render, with its name in tables.
struct NamedMethod {
  std::string key, label;
  RenderOptions options;
};
NamedMethod samples_method(int spp);
NamedMethod paper_method();
NamedMethod map_method(Quality quality);
/// 1 and 16 samples, the paper's way, and the map at every quality from fast up: what Figs. 8 and 9 compare.
std::vector<NamedMethod> compared_methods();
NamedMethod parameters_method();

/// The object of `texture`, seen so that a map of `size` texels is minified that much.
Scene scene_of(const BakedTexture& texture, int size, double minification, int view = 0, int largest = 0);

Image render_picture(const Scene& scene, const std::vector<ObjectData>& data, const RenderOptions& options,
                     int frame = 0);

/// One sample, averaged parameters where the shader has them, the map and the reference.
Slider compare_methods(const std::string& title, const Scene& scene, const std::vector<ObjectData>& data,
                       int reference_spp, int zoom);

/// What frames cost, all together.
struct SequenceCost {
  double seconds = 0, pixels = 0;
  RenderCounts counts;
};
/// Renders `frames` frames by all methods in turn, so that whatever else the machine does befalls all of them. `step`
/// is told the part done.
std::vector<SequenceCost> render_sequence(const std::function<Scene(int)>& scene_at, int frames,
                                          const std::vector<ObjectData>& data, const std::vector<NamedMethod>& methods,
                                          const std::function<void(double)>& step);

/// Root mean square errors over the interior, and the mean of the reference.
struct SequenceErrors {
  std::vector<double> rmse, rmse_clamped;  ///< one a method; linear light
  double residual = 0, mean = 0;           ///< of the reference
};
SequenceErrors measure_errors(const std::function<Scene(int)>& scene_at, std::span<const int> frames,
                              const std::vector<ObjectData>& data, const std::vector<NamedMethod>& methods,
                              int reference_spp);

}  // namespace redmap::bench
