#include "gpu/map_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/seam_memory.h"
#include "lobes/gaussian_points.h"
#include "lobes/lobe_lanes.h"
#include "surface/seams.h"

namespace redmap {
namespace {

int widths_of(const WidthsInUse& in_use) { return static_cast<int>(std::ranges::count(in_use, true)); }

LobeModel model_of(const ReductionMap& map, std::size_t basis) {
  return basis < map.lobes.size() ? map.lobes[basis] : LobeModel{};
}

/// The variance of normals up to which few of them say what a highlight becomes. Edges of what no model fits are no
/// polynomials either.
float most_variance(const ReductionMap& map, bool is_fast) {
  float narrowest = 1, few = is_fast ? kFewNormalsFast : kFewNormals;
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    const LobeModel model = model_of(map, b);
    narrowest = std::min(narrowest, narrowest_highlight(model));
    if (model.error > kTrustedError) few = kSpreadBegin;
  }
  return few * few * narrowest * narrowest;
}

using Words = std::vector<std::uint32_t>;

void append(float value, Words& words) { words.push_back(std::bit_cast<std::uint32_t>(value)); }
void append(Vec3 v, Words& words) { append(v.x, words), append(v.y, words), append(v.z, words); }
void append(const LobeModel::Colour& c, Words& words) {
  for (const float value : c) append(value, words);
}

/// How bright a reflectance gets: in the middle of its highlight, with light and viewer 30 degrees from the half
/// vector.
float brightness(const LobeModel& model, const std::vector<int>& used) {
  const LobeModel::Angle& angle = model.angles[3];
  float sum = 0;
  for (int c = 0; c < 3; ++c) {
    sum += angle.constant[c] + angle.cosine[c];
    for (const int k : used) sum += angle.amplitude[k][c];
  }
  return std::max(sum / 3, 1e-6f);
}

/// Widths that are not used are 1 wide and have no amplitude.
void append_model(const LobeModel& model, int widths, Words& words) {
  const WidthsInUse in_use = widths_in_use(model);
  std::vector<int> used;
  for (int k = 0; k < LobeModel::kWidths; ++k)
    if (in_use[k]) used.push_back(k);
  append(narrowest_highlight(model), words);
  append(model.error <= kTrustedError ? 1.0f : 0.0f, words);
  append(static_cast<float>(used.size()), words), append(brightness(model, used), words);
  const auto is_used = [&](int k) { return k < static_cast<int>(used.size()); };
  for (int k = 0; k < widths; ++k) append(is_used(k) ? LobeModel::width(used[k]) : 1.0f, words);
  for (const LobeModel::Angle& angle : model.angles) {
    append(angle.constant, words), append(angle.cosine, words), append(angle.stretch, words);
    for (int k = 0; k < widths; ++k) append(is_used(k) ? angle.amplitude[used[k]] : LobeModel::Colour{}, words);
  }
}

constexpr int kMostLevels = 16;

/// Where each level starts, in bytes; then the bytes, four to a word.
void append_normals(const NormalPyramid& normals, Words& words) {
  std::vector<std::uint8_t> bytes;
  Words starts(kMostLevels, 0);
  for (int level = 0; level < normals.levels(); ++level) {
    starts[level] = static_cast<std::uint32_t>(bytes.size());
    for (int y = 0; y < normals.extent(level).height; ++y) {
      const auto row = normals.row(level, y);
      bytes.insert(bytes.end(), row.begin(), row.end());
    }
  }
  bytes.resize((bytes.size() + 3) / 4 * 4);
  words.insert(words.end(), starts.begin(), starts.end());
  const std::size_t first = words.size();
  words.resize(first + bytes.size() / 4);
  std::memcpy(&words[first], bytes.data(), bytes.size());
}

/// The scales of both moments; where each level starts, in words; then a word a texel: coverage and both moments.
void append_grains(const WeightPyramid& grains, Words& words) {
  for (const float scale : grains.scales()) append(scale, words);
  const std::size_t starts = words.size();
  words.resize(starts + kMostLevels, 0);
  const std::size_t first = words.size();
  for (int level = 0; level < grains.levels(); ++level) {
    words[starts + level] = static_cast<std::uint32_t>(words.size() - first);
    for (int y = 0; y < grains.extent(level).height; ++y) {
      const std::uint8_t* texel = grains.row(level, y).data();
      for (int x = 0; x < grains.extent(level).width; ++x, texel += grains.texel_stride())
        words.push_back(texel[0] | texel[1] << 8 | texel[2] << 16);
    }
  }
}

/// From the root on; nodes above the leaves are joined as the CPU joins them.
void append_clusters(const SurfaceClusters& clusters, Words& words) {
  for (std::size_t node = 1; node < 2 * clusters.leaves(); ++node) {
    const ClusterPlace place = clusters.place(node);
    append(place.position, words), append(place.normal, words);
    append(place.radius, words), append(place.variance, words);
    for (const float weight : clusters.weights(node)) append(weight, words);
  }
}

}  // namespace

void set_map_traits(const ReductionMap& map, const Surface& surface, ObjectTraits& traits) {
  traits.basis = traits.channels = static_cast<int>(map.basis.size());
  traits.has_coverage = !is_covered(map.weights);
  traits.wraps_u = map.weights.wraps_u();
  traits.has_normals = !map.normals.empty();
  traits.hides_frames = map.hides_frames;
  traits.has_grains = !map.tangents.empty();
  // Under mixtures of normals the CPU asks the atlas alone (render/map_shading.cpp).
  traits.leaves = map.normals.empty() ? map.clusters.leaves() : 0;
  const Seams* seams = surface.seams();
  traits.mends_seams = map.normals.empty() && traits.has_coverage && seams && !seams->empty();
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    const LobeModel model = model_of(map, b);
    traits.widths = std::max(traits.widths, widths_of(widths_in_use(model)));
    traits.draws_normals |= model.error > kTrustedError;
  }
}

void set_map_block(const ReductionMap& map, bool is_fast, ObjectBlock& block) {
  const Extent extent = map.weights.extent(0);
  // With normals one kernel does it all; a grain is drawn wherever it is.
  const float most = !map.normals.empty() ? 1e30f : !map.tangents.empty() ? -1.0f : most_variance(map, is_fast);
  block.numbers.z = static_cast<std::uint32_t>(map.basis.size());
  block.map = {static_cast<float>(extent.width), static_cast<float>(extent.height),
               static_cast<float>(map.weights.levels()), most};
  float scales[kMaxChannels] = {};
  std::ranges::copy(map.weights.scales(), scales);
  for (int i = 0; i < kMaxChannels / 4; ++i)
    block.scales[i] = {scales[4 * i], scales[4 * i + 1], scales[4 * i + 2], scales[4 * i + 3]};
}

WeightTexels weight_texels(const ReductionMap& map) {
  const WeightPyramid& weights = map.weights;
  const bool has_coverage = !is_covered(weights);
  const int channels = weights.channels(), layers = (channels + (has_coverage ? 1 : 0) + 3) / 4;
  std::vector<std::byte> texels;
  for (int level = 0; level < weights.levels(); ++level) {
    const Extent extent = weights.extent(level);
    for (int layer = 0; layer < layers; ++layer)
      for (int y = 0; y < extent.height; ++y) {
        const auto row = weights.row(level, y);
        for (int x = 0; x < extent.width; ++x) {
          const std::uint8_t* texel = &row[static_cast<std::size_t>(x) * weights.texel_stride()];  // coverage first
          for (int c = 4 * layer; c < 4 * layer + 4; ++c) {
            const int value = c < channels ? (texel[1 + c] * texel[0] + 127) / 255 : c == channels ? texel[0] : 0;
            texels.push_back(static_cast<std::byte>(value));
          }
        }
      }
  }
  return {layers, std::move(texels)};
}

LayeredTexture make_weight_texture(const Device& device, const ReductionMap& map) {
  const WeightTexels all = weight_texels(map);
  const WeightPyramid& weights = map.weights;
  return LayeredTexture(device, TexelKind::kBytes, weights.extent(0), all.layers, weights.levels(), weights.wraps_u(),
                        all.texels);
}

std::vector<std::uint32_t> map_data(const ReductionMap& map, const Surface& surface, const ObjectTraits& traits) {
  Words words;
  const std::vector<Frame> frames = basis_frames(map);
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    const BasisPlace& place = map.basis[b];
    append(place.position, words), append(place.normal, words), append(place.tangent, words);
    append(place.uv.x, words), append(place.uv.y, words), append(0.0f, words);
    if (!frames.empty()) append(frames[b].x, words), append(frames[b].z, words);
  }
  for (std::size_t b = 0; b < map.basis.size(); ++b) append_model(model_of(map, b), traits.widths, words);
  for (const Vec2 point : gaussian_points()) append(point.x, words), append(point.y, words);
  const std::size_t grains = words.size();
  if (traits.has_grains) append(0.0f, words);
  if (traits.has_normals) append_normals(map.normals, words);
  if (traits.leaves > 0) append_clusters(map.clusters, words);
  if (traits.mends_seams) {
    const Words seams = seam_data(surface);
    words.insert(words.end(), seams.begin(), seams.end());
  }
  if (traits.has_grains) {
    words[grains] = static_cast<std::uint32_t>(words.size());
    append_grains(map.tangents, words);
  }
  return words;
}

}  // namespace redmap
