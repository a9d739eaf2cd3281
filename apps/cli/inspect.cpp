// `redmap inspect`: what a reduction map says about itself, and pictures of it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/image.h"
#include "certificate_text.h"
#include "commands.h"
#include "common.h"
#include "map/map_file.h"
#include "map_json.h"
#include "scene/map_shader.h"
#include "shader/shader.h"
#include "shader/shading_frames.h"

namespace redmap::cli {

namespace {

/// Pixels across the picture of a basis reflectance.
constexpr int kSpherePixels = 256;
/// The sphere's light: from above left, as in most such pictures, and bright enough for white to be white.
constexpr Vec3 kToLight{-0.45f, 0.55f, 0.70f};
constexpr float kIrradiance = kPi;
/// Most texels across a picture: finer levels of a large map would be gigabytes of floats that no viewer shows.
constexpr int kMaxPictureTexels = 4096;
/// What basis reflectances are painted with in the picture of all weights: ten colours that can be told apart
/// (Tableau 10, in linear light), then again.
constexpr Rgb kColours[] = {{0.08f, 0.20f, 0.40f}, {0.89f, 0.26f, 0.03f}, {0.09f, 0.37f, 0.08f}, {0.76f, 0.09f, 0.09f},
                            {0.17f, 0.41f, 0.37f}, {0.86f, 0.57f, 0.08f}, {0.42f, 0.19f, 0.36f}, {1.00f, 0.33f, 0.38f},
                            {0.33f, 0.18f, 0.12f}, {0.48f, 0.42f, 0.40f}};

struct Options {
  std::string map, pictures, device;
  CommonOptions common;
};

/// One value of every texel of a level, v upwards.
template <typename Value>
Image level_picture(const WeightPyramid& weights, int level, int channels, const Value& value) {
  const Extent extent = weights.extent(level);
  Image picture(extent.width, extent.height, channels);
  for (int y = 0; y < extent.height; ++y)
    for (int x = 0; x < extent.width; ++x) value(x, y, picture, x, extent.height - 1 - y);
  return picture;
}

/// The finest level that is shown.
int first_level(const WeightPyramid& weights) {
  int level = 0;
  while (std::max(weights.extent(level).width, weights.extent(level).height) > kMaxPictureTexels) ++level;
  return level;
}

Image coverage_picture(const WeightPyramid& weights, int level) {
  return level_picture(weights, level, 1, [&](int x, int y, Image& picture, int column, int row) {
    picture.at(column, row, 0) = weights.coverage(level, x, y);
  });
}

Image weight_picture(const WeightPyramid& weights, int level, int basis) {
  return level_picture(weights, level, 1, [&](int x, int y, Image& picture, int column, int row) {
    picture.at(column, row, 0) = weights.coverage(level, x, y) * weights.value(level, x, y, basis);
  });
}

/// All weights of a level in one picture, a colour each; bare texels are black.
Image mixture_picture(const WeightPyramid& weights, int level) {
  return level_picture(weights, level, 3, [&](int x, int y, Image& picture, int column, int row) {
    Rgb colour;
    for (int b = 0; b < weights.channels(); ++b)
      colour += kColours[b % std::size(kColours)] * weights.value(level, x, y, b);
    picture.set_rgb(column, row, colour * weights.coverage(level, x, y));
  });
}

/// A basis reflectance on a lit sphere, seen from far away.
Image sphere_picture(const BoundPatterns& patterns, std::size_t basis) {
  const Vec3 to_light = normalized(kToLight), to_viewer{0, 0, 1};
  DirectionPairs pairs;
  std::vector<std::size_t> pixels;
  std::vector<Frame> frames;
  for (int y = 0; y < kSpherePixels; ++y)
    for (int x = 0; x < kSpherePixels; ++x) {
      const float half_size = 0.5f * kSpherePixels, radius = 0.95f * half_size;
      const float u = (static_cast<float>(x) + 0.5f - half_size) / radius;
      const float v = (half_size - static_cast<float>(y) - 0.5f) / radius;
      if (u * u + v * v >= 1) continue;
      pixels.push_back(static_cast<std::size_t>(y) * kSpherePixels + x);
      frames.push_back(make_frame({u, v, std::sqrt(1 - u * u - v * v)}, {1, 0, 0}));
    }
  pairs.resize(pixels.size());
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    const Frame& frame = frames[std::min(i, frames.size() - 1)];
    pairs.to_light.set(i, frame.to_local(to_light));
    pairs.to_viewer.set(i, frame.to_local(to_viewer));
  }
  Planes<3> radiance, emission;
  patterns.radiance_one(basis, pairs, radiance);
  patterns.emission(emission);
  Image picture(kSpherePixels, kSpherePixels, 3);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    picture.set_rgb(static_cast<int>(pixels[i] % kSpherePixels), static_cast<int>(pixels[i] / kSpherePixels),
                    radiance.rgb(i) * kIrradiance + emission.rgb(basis));
  return picture;
}

void write_pictures(const ReductionMap& map, const Shader& shader, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto write = [&](const Image& picture, const std::string& name) {
    stop_if_interrupted();
    write_image(picture, folder / name);
    fmt::print("{}\n", (folder / name).string());
  };
  const int first = first_level(map.weights);
  write(coverage_picture(map.weights, first), "coverage.png");
  const std::unique_ptr<BoundPatterns> patterns = bind_in_frames(shader, basis_points(map), basis_frames(map));
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    write(sphere_picture(*patterns, b), fmt::format("basis{:02}.png", b));
    write(weight_picture(map.weights, first, static_cast<int>(b)), fmt::format("weight{:02}.png", b));
  }
  for (int level = first; level < map.weights.levels(); ++level)
    write(mixture_picture(map.weights, level), fmt::format("level{:02}.png", level));
}

void inspect(const Options& options) {
  const ReductionMap map = read_map(options.map);
  const Extent extent = map.weights.extent(0);
  fmt::print("shader     {}\n", map.shader);
  for (const auto& [name, value] : map.parameters) fmt::print("  {:16} {}\n", name, fmt::join(value, " "));
  fmt::print("basis      {}\n", map.basis.size());
  for (const BasisPlace& p : map.basis)
    fmt::print("  at uv {:.4f} {:.4f}, position {:.4g} {:.4g} {:.4g}\n", p.uv.x, p.uv.y, p.position.x, p.position.y,
               p.position.z);
  fmt::print("size       {}x{}, {} levels, {:.1f} MB in memory\n", extent.width, extent.height, map.weights.levels(),
             static_cast<double>(texel_bytes(map)) * 1e-6);
  fmt::print("residual   {:.4f} of {:g}\n", map.residual, map.tolerance);
  fmt::print("verdict    {}{}{}\n", verdict_name(map.verdict), map.verdict_reason.empty() ? "" : ": ",
             map.verdict_reason);
  if (map.certificate) fmt::print("certificate\n{}", certificate_text(*map.certificate));
  if (!options.pictures.empty()) write_pictures(map, *shader_of(map, options.map, options.device), options.pictures);
  write_json(options.common.json, map_json(map));
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("inspect", "Show what is in a reduction map");
  sub->footer(
      "Examples:\n"
      "  redmap inspect maps/bunny.exr\n"
      "  redmap inspect maps/bunny.exr --pictures out    coverage, basis, weights and levels as PNG");
  auto options = std::make_shared<Options>();
  sub->add_option("map", options->map, "the map's file")->required();
  sub->add_option("--pictures", options->pictures,
                  "folder for pictures of the coverage, each basis, weight and level, from 4096 texels down");
  add_device_option(*sub, options->device);
  add_common_options(*sub, options->common);
  sub->callback([options] { inspect(*options); });
}

}  // namespace redmap::cli
