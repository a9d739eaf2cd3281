// What a lookup costs: 4, 8 and 16 channels, anisotropy 1, 2 and 4, pixels of a frame and random places, one at a time
// and in batches; beside it the anisotropic lookup of OpenImageIO's texture system on the same bytes, all of them in
// its cache. One thread. The column `each` is the processor time of one lookup; on a busy machine ask for the fastest
// of many:
//   redmap_lookup_bench --benchmark_repetitions=20 --benchmark_min_time=0.05 --benchmark_report_aggregates_only
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "map/pyramid.h"

namespace redmap {
namespace {

namespace fs = std::filesystem;

/// A map of the size the demo bakes.
constexpr Extent kExtent{1024, 1024};
/// Pixels of a frame, along a side, and of the tiles it is rendered in.
constexpr int kFrameSide = 256, kTileSide = 16;
/// Lookups handed over at once in the batch runs: those of a tile of the renderer with four rays a pixel.
constexpr std::size_t kBatch = 4 * kTileSide * kTileSide;

enum class Places { kFrame, kRandom };

/// Smooth waves with noise, fully covered.
BaseLevel content(int channels) {
  BaseLevel base(kExtent, channels, false);
  Random random(1);
  for (std::size_t t = 0; t < base.coverage.size(); ++t) {
    base.coverage[t] = 1;
    const float x = static_cast<float>(t % kExtent.width), y = static_cast<float>(t / kExtent.width);
    for (int c = 0; c < channels; ++c)
      base.values[t * channels + c] =
          0.4f + 0.3f * std::sin(0.01f * x + static_cast<float>(c)) * std::cos(0.02f * y) + 0.2f * random.next_float();
  }
  return base;
}

/// A footprint of `minor` by `anisotropy * minor` texels, its major axis at `angle` from u.
Footprint footprint_at(Vec2 uv, float minor, float anisotropy, float angle) {
  const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
  const float texel = 1.0f / static_cast<float>(kExtent.width);
  return {uv, along * (anisotropy * minor * texel), across * (minor * texel)};
}

/// Neighbouring pixels in the order of tiles: each footprint begins where the last one ends. The footprint's size
/// changes over the frame as on a receding plane, from 1 texel to 4.
std::vector<Footprint> frame_footprints(float anisotropy) {
  const float angle = 0.5f;
  std::vector<Footprint> footprints;
  for (int tile = 0; tile < (kFrameSide / kTileSide) * (kFrameSide / kTileSide); ++tile)
    for (int pixel = 0; pixel < kTileSide * kTileSide; ++pixel) {
      const int x = tile % (kFrameSide / kTileSide) * kTileSide + pixel % kTileSide;
      const int y = tile / (kFrameSide / kTileSide) * kTileSide + pixel / kTileSide;
      const float minor = 1 + 3 * static_cast<float>(y) / kFrameSide;
      Footprint f = footprint_at({0.3f, 0.1f}, minor, anisotropy, angle);
      f.uv = f.uv + f.duv_dx * static_cast<float>(x) + f.duv_dy * static_cast<float>(y);
      f.uv = {f.uv.x - std::floor(f.uv.x), f.uv.y - std::floor(f.uv.y)};
      footprints.push_back(f);
    }
  return footprints;
}

/// Anywhere, at any angle, 1 to 8 texels across.
std::vector<Footprint> random_footprints(float anisotropy) {
  Random random(2);
  std::vector<Footprint> footprints;
  for (int i = 0; i < kFrameSide * kFrameSide; ++i) {
    const float minor = std::exp2(3 * random.next_float());
    const float angle = 2 * std::numbers::pi_v<float> * random.next_float();
    footprints.push_back(footprint_at({random.next_float(), random.next_float()}, minor, anisotropy, angle));
  }
  return footprints;
}

std::vector<Footprint> footprints(Places places, int anisotropy) {
  const float ratio = static_cast<float>(anisotropy);
  return places == Places::kFrame ? frame_footprints(ratio) : random_footprints(ratio);
}

void report(benchmark::State& state, std::size_t lookups) {
  using benchmark::Counter;
  state.counters["each"] = Counter(static_cast<double>(lookups), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void single_lookups(benchmark::State& state, int channels, int anisotropy, Places places) {
  const WeightPyramid pyramid(content(channels));
  const std::vector<Footprint> wanted = footprints(places, anisotropy);
  for (auto _ : state)
    for (const Footprint& f : wanted) benchmark::DoNotOptimize(pyramid.lookup(f));
  report(state, wanted.size());
}

void batch_lookups(benchmark::State& state, int channels, int anisotropy, Places places) {
  const WeightPyramid pyramid(content(channels));
  const std::vector<Footprint> wanted = footprints(places, anisotropy);
  std::vector<FilteredTexel> found(kBatch);
  for (auto _ : state)
    for (std::size_t i = 0; i < wanted.size(); i += kBatch) {
      pyramid.lookup(std::span(wanted).subspan(i, kBatch), LookupFilter::kVarianceMatched, found);
      benchmark::DoNotOptimize(found.data());
    }
  report(state, wanted.size());
}

/// A texture file of content(), made once for each number of channels; empty if OpenImageIO could not write it.
class TextureFile {
 public:
  explicit TextureFile(int channels)
      : path_((fs::temp_directory_path() / fmt::format("redmap_lookup_bench_{}.tif", channels)).string()) {
    const BaseLevel base = content(channels);
    OIIO::ImageBuf image(OIIO::ImageSpec(kExtent.width, kExtent.height, channels, OIIO::TypeDesc::FLOAT));
    image.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, base.values.data());
    OIIO::ImageSpec how;
    how.set_format(OIIO::TypeDesc::UINT8);
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, path_, how)) path_.clear();
  }
  ~TextureFile() { fs::remove(path_); }
  TextureFile(const TextureFile&) = delete;
  TextureFile& operator=(const TextureFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void openimageio_lookups(benchmark::State& state, int channels, int anisotropy, Places places) {
  const TextureFile file(channels);
  OIIO::TextureSystem* textures = OIIO::TextureSystem::create(false);
  textures->attribute("max_memory_MB", 2048.0f);
  OIIO::TextureSystem::Perthread* thread = textures->get_perthread_info();
  OIIO::TextureSystem::TextureHandle* texture = textures->get_texture_handle(OIIO::ustring(file.path()), thread);

  OIIO::TextureOpt options;
  options.anisotropic = anisotropy;
  options.mipmode = OIIO::TextureOpt::MipModeAniso;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.swrap = options.twrap = OIIO::TextureOpt::WrapClamp;
  const auto lookup = [&](const Footprint& f) {
    float found[kMaxChannels];
    const bool ok = textures->texture(texture, thread, options, f.uv.x, f.uv.y, f.duv_dx.x, f.duv_dx.y, f.duv_dy.x,
                                      f.duv_dy.y, channels, found);
    benchmark::DoNotOptimize(found);
    return ok;
  };

  // Once before the clock runs, so that all tiles are in the cache.
  const std::vector<Footprint> wanted = footprints(places, anisotropy);
  for (const Footprint& f : wanted)
    if (!lookup(f)) return state.SkipWithError(textures->geterror().c_str());
  for (auto _ : state)
    for (const Footprint& f : wanted) lookup(f);
  report(state, wanted.size());
  OIIO::TextureSystem::destroy(textures);
}

/// Of several repetitions: what other programs on the machine disturbed least.
double fastest(const std::vector<double>& times) { return *std::min_element(times.begin(), times.end()); }

void add(const char* name, void (*run)(benchmark::State&, int, int, Places)) {
  for (int channels : {4, 8, 16})
    for (Places places : {Places::kFrame, Places::kRandom})
      for (int anisotropy : {1, 2, 4}) {
        const char* where = places == Places::kFrame ? "frame" : "random";
        const std::string title = fmt::format("{}/{} channels/{}/anisotropy {}", name, channels, where, anisotropy);
        benchmark::RegisterBenchmark(title.c_str(), run, channels, anisotropy, places)
            ->Unit(benchmark::kMillisecond)
            ->ComputeStatistics("fastest", fastest);
      }
}

}  // namespace
}  // namespace redmap

int main(int argc, char** argv) {
  redmap::add("single", redmap::single_lookups);
  redmap::add("batch", redmap::batch_lookups);
  redmap::add("openimageio", redmap::openimageio_lookups);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
