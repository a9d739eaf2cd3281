// Building pyramids: coverage-weighted box reduction, then pull-push where nothing is covered (paper, section 4.4;
// pull-push after Gortler et al. 1996).
#include "map/pyramid.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "map/overlap.h"

namespace redmap {
namespace {

/// Components read at once by the lookup, kept readable past the last texel and past the row below it.
constexpr std::size_t kTail = kMaxChannels;

/// Bytes a texel: a multiple of two, and of four from there on, so that few texels straddle cache lines. Floats are
/// left tight.
template <typename Component>
int padded_texel(int channels) {
  return std::is_same_v<Component, float> ? channels + 1 : channels == 1 ? 2 : (channels + 1 + 3) / 4 * 4;
}

void reduce_texel(const BaseLevel& fine, const Overlap& across, const Overlap& down, float* values, float& coverage) {
  coverage = 0;
  for (std::size_t j = 0; j < down.part.size(); ++j)
    for (std::size_t i = 0; i < across.part.size(); ++i) {
      const std::size_t t = static_cast<std::size_t>(down.first + j) * fine.extent.width + across.first + i;
      const float part = down.part[j] * across.part[i] * fine.coverage[t];
      if (part <= 0) continue;
      coverage += part;
      for (int c = 0; c < fine.channels; ++c) values[c] += part * fine.values[t * fine.channels + c];
    }
  if (coverage > 0)
    for (int c = 0; c < fine.channels; ++c) values[c] /= coverage;
}

BaseLevel reduce(const BaseLevel& fine) {
  BaseLevel coarse({std::max(1, fine.extent.width / 2), std::max(1, fine.extent.height / 2)}, fine.channels,
                   fine.wraps_u);
  const std::vector<Overlap> across = overlaps(fine.extent.width, coarse.extent.width);
  const std::vector<Overlap> down = overlaps(fine.extent.height, coarse.extent.height);
  parallel_for(coarse.extent.height, [&](std::size_t y) {
    for (int x = 0; x < coarse.extent.width; ++x) {
      const std::size_t t = y * coarse.extent.width + x;
      reduce_texel(fine, across[x], down[y], &coarse.values[t * coarse.channels], coarse.coverage[t]);
    }
  });
  return coarse;
}

/// Largest covered value of each channel; 1 for a channel that is zero everywhere.
std::array<float, kMaxChannels> largest_values(const BaseLevel& base) {
  std::array<float, kMaxChannels> largest{};
  for (std::size_t t = 0; t < base.coverage.size(); ++t)
    if (base.coverage[t] > 0)
      for (int c = 0; c < base.channels; ++c) largest[c] = std::max(largest[c], base.values[t * base.channels + c]);
  for (int c = 0; c < base.channels; ++c)
    if (!(largest[c] > 0)) largest[c] = 1;
  return largest;
}

template <typename Component>
Component quantised(float value) {
  if constexpr (std::is_same_v<Component, float>)
    return value;
  else
    return static_cast<Component>(std::lrint(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

/// As quantised(), but what is covered at all stays covered: nil coverage marks texels whose values were pulled in.
template <typename Component>
Component quantised_coverage(float coverage) {
  const Component stored = quantised<Component>(coverage);
  return std::is_same_v<Component, float> || coverage <= 0 ? stored : std::max<Component>(stored, 1);
}

/// The two coarser texels that a finer texel's centre lies between, along one axis.
struct Between {
  int first, second;
  float second_part;

  Between(int index, int fine, int coarse, bool wraps) {
    float x = (static_cast<float>(index) + 0.5f) * static_cast<float>(coarse) / static_cast<float>(fine) - 0.5f;
    if (!wraps) x = std::clamp(x, 0.0f, static_cast<float>(coarse - 1));
    const float below = std::floor(x);
    second_part = x - below;
    first = (static_cast<int>(below) + coarse) % coarse;
    second = wraps ? (first + 1) % coarse : std::min(first + 1, coarse - 1);
  }
  float mix(float a, float b) const { return a + (b - a) * second_part; }
};

}  // namespace

BaseLevel::BaseLevel(Extent size, int channel_count, bool wraps)
    : extent(size),
      channels(channel_count),
      wraps_u(wraps),
      values(static_cast<std::size_t>(size.width) * size.height * channel_count),
      coverage(static_cast<std::size_t>(size.width) * size.height) {}

template <typename Component>
void Pyramid<Component>::allocate(Extent base, int channels, bool wraps_u) {
  if (base.width < 1 || base.height < 1)
    throw Error("pyramid: expected at least 1x1 texels, found {}x{}", base.width, base.height);
  if (channels < 1 || channels > kMaxChannels)
    throw Error("pyramid: expected 1 to {} channels, found {}", kMaxChannels, channels);
  channels_ = channels;
  texel_stride_ = padded_texel<Component>(channels);
  wraps_u_ = wraps_u;
  std::size_t offset = 0;
  for (Extent e = base;; e = {std::max(1, e.width / 2), std::max(1, e.height / 2)}) {
    const std::size_t row_stride = static_cast<std::size_t>(e.width + 1) * texel_stride_;
    levels_.push_back({e, offset, row_stride});
    offset += row_stride * e.height;
    if (e == Extent{1, 1}) break;
  }
  data_.resize(offset + levels_[0].row_stride + kTail);
}

template <typename Component>
Pyramid<Component>::Pyramid(Extent base, int channels, bool wraps_u, std::span<const float> scales) {
  allocate(base, channels, wraps_u);
  if (scales.size() != static_cast<std::size_t>(channels))
    throw Error("pyramid: expected {} scales, found {}", channels, scales.size());
  std::copy(scales.begin(), scales.end(), scales_.begin());
}

template <typename Component>
Pyramid<Component>::Pyramid(const BaseLevel& base) {
  allocate(base.extent, base.channels, base.wraps_u);
  const std::size_t texels = static_cast<std::size_t>(base.extent.width) * base.extent.height;
  if (base.coverage.size() != texels || base.values.size() != texels * base.channels)
    throw Error("pyramid: expected {} texels of {} channels, found {} coverages and {} values", texels, base.channels,
                base.coverage.size(), base.values.size());
  if constexpr (std::is_same_v<Component, float>)
    std::fill_n(scales_.begin(), channels_, 1.0f);
  else
    scales_ = largest_values(base);

  store(0, base);
  BaseLevel coarser;
  for (int level = 1; level < levels(); ++level) {
    coarser = reduce(level == 1 ? base : coarser);
    store(level, coarser);
  }
  for (int level = levels() - 2; level >= 0; --level) fill_uncovered(level);
  pad_rows();
}

template <typename Component>
void Pyramid<Component>::store(int level, const BaseLevel& texels) {
  parallel_for(texels.extent.height, [&](std::size_t y) {
    for (int x = 0; x < texels.extent.width; ++x) {
      const std::size_t t = y * texels.extent.width + x;
      Component* out = texel(level, x, static_cast<int>(y));
      out[0] = quantised_coverage<Component>(texels.coverage[t]);
      for (int c = 0; c < channels_ && out[0] > 0; ++c)
        out[1 + c] = quantised<Component>(texels.values[t * channels_ + c] / scales_[c]);
    }
  });
}

/// Bilinear values of the next coarser level, which is complete already.
template <typename Component>
void Pyramid<Component>::fill_uncovered(int level) {
  const Extent fine = extent(level), coarse = extent(level + 1);
  parallel_for(fine.height, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const Between down(y, fine.height, coarse.height, false);
    for (int x = 0; x < fine.width; ++x) {
      Component* out = texel(level, x, y);
      if (out[0] > 0) continue;
      const Between across(x, fine.width, coarse.width, wraps_u_);
      for (int c = 0; c < channels_; ++c) {
        const auto along_row = [&](int coarse_y) {
          return across.mix(value(level + 1, across.first, coarse_y, c), value(level + 1, across.second, coarse_y, c));
        };
        out[1 + c] = quantised<Component>(down.mix(along_row(down.first), along_row(down.second)) / scales_[c]);
      }
    }
  });
}

template <typename Component>
void Pyramid<Component>::pad_rows() {
  for (int level = 0; level < levels(); ++level) {
    const int width = extent(level).width;
    parallel_for(extent(level).height, [&](std::size_t y) {
      const int row_y = static_cast<int>(y);
      std::copy_n(texel(level, wraps_u_ ? 0 : width - 1, row_y), texel_stride_, texel(level, width, row_y));
    });
  }
}

template <typename Component>
std::span<Component> Pyramid<Component>::row(int level, int y) {
  return {texel(level, 0, y), static_cast<std::size_t>(extent(level).width) * texel_stride_};
}

template <typename Component>
std::span<const Component> Pyramid<Component>::row(int level, int y) const {
  return {texel(level, 0, y), static_cast<std::size_t>(extent(level).width) * texel_stride_};
}

template class Pyramid<std::uint8_t>;
template class Pyramid<float>;

}  // namespace redmap
