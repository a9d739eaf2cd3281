// Building the pyramid of normals: four texels' Gaussians become those of one by merging, again and again, the two that
// lose least by it (Runnalls 2007).
#include "map/normal_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "map/overlap.h"

namespace redmap {
namespace {

/// Added to covariances before they are compared: what is narrower than any highlight is all the same.
constexpr float kCovarianceFloor = 4e-4f;
/// What it costs to merge Gaussians whose weights differ by all of their scale, beside their normals.
constexpr float kWeightCost = 2;

/// Moments of the normals of some area, and of the weights that go with them: all sums over its share.
struct Moments {
  float share = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  std::array<float, kMaxChannels> weights{};

  void add(const Moments& m) {
    share += m.share, x += m.x, y += m.y, xx += m.xx, xy += m.xy, yy += m.yy;
    for (std::size_t b = 0; b < weights.size(); ++b) weights[b] += m.weights[b];
  }
  NormalGaussian gaussian() const {
    const float mx = x / share, my = y / share;
    return {mx, my, std::max(0.0f, xx / share - mx * mx), xy / share - mx * my, std::max(0.0f, yy / share - my * my)};
  }
};

Moments moments_of(const NormalGaussian& n, float share) {
  Moments m;
  m.share = share, m.x = share * n.x, m.y = share * n.y;
  m.xx = share * (n.xx + n.x * n.x), m.xy = share * (n.xy + n.x * n.y), m.yy = share * (n.yy + n.y * n.y);
  return m;
}

float log_determinant(const NormalGaussian& n) {
  return std::log(std::max((n.xx + kCovarianceFloor) * (n.yy + kCovarianceFloor) - n.xy * n.xy, 1e-12f));
}

/// The Gaussians of a texel to be, at most those of 3 x 3 texels.
class MixtureReduction {
 public:
  static constexpr int kMost = 9 * NormalPyramid::kGaussians;
  explicit MixtureReduction(int basis) : basis_(basis) {}
  void clear() { size_ = 0; }
  void add(const Moments& m) {
    parts_[size_] = m;
    spread_[size_] = log_determinant(m.gaussian());
    ++size_;
  }
  /// Merges down to `count` parts.
  void reduce(int count);
  int size() const { return size_; }
  const Moments& part(int i) const { return parts_[i]; }

 private:
  float cost(int a, int b) const;

  int basis_, size_ = 0;
  std::array<Moments, kMost> parts_;
  std::array<float, kMost> spread_;
};

float MixtureReduction::cost(int a, int b) const {
  const Moments &p = parts_[a], &q = parts_[b];
  Moments both;
  both.share = p.share + q.share, both.x = p.x + q.x, both.y = p.y + q.y;
  both.xx = p.xx + q.xx, both.xy = p.xy + q.xy, both.yy = p.yy + q.yy;
  float difference = 0;
  for (int i = 0; i < basis_; ++i) {
    const float d = p.weights[i] / p.share - q.weights[i] / q.share;
    difference += d * d;
  }
  return both.share * log_determinant(both.gaussian()) - p.share * spread_[a] - q.share * spread_[b] +
         kWeightCost * difference * p.share * q.share / both.share;
}

void MixtureReduction::reduce(int count) {
  while (size_ > count) {
    float least = std::numeric_limits<float>::max();
    int first = 0, second = 1;
    for (int a = 0; a < size_; ++a)
      for (int b = a + 1; b < size_; ++b)
        if (const float c = cost(a, b); c < least) least = c, first = a, second = b;
    parts_[first].add(parts_[second]);
    spread_[first] = log_determinant(parts_[first].gaussian());
    --size_;
    parts_[second] = parts_[size_], spread_[second] = spread_[size_];
  }
}

std::uint8_t quantised(float value) {
  return static_cast<std::uint8_t>(std::lrint(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// The reduced mixture as bytes. The shares sum to 255.
void store(const MixtureReduction& mixture, int basis, std::uint8_t* to) {
  float total = 0;
  for (int i = 0; i < mixture.size(); ++i) total += mixture.part(i).share;
  int left = 255;
  for (int i = 0; i < mixture.size(); ++i) {
    const Moments& m = mixture.part(i);
    const int share = i + 1 == mixture.size() ? left : std::min<int>(left, quantised(m.share / total));
    left -= share;
    if (share == 0) continue;
    std::uint8_t* gaussian = to + static_cast<std::ptrdiff_t>(i) * (7 + basis);
    const PackedNormals packed = pack(m.gaussian());
    std::copy(packed.bytes.begin(), packed.bytes.end(), gaussian);
    gaussian[6] = static_cast<std::uint8_t>(share);
    for (int b = 0; b < basis; ++b) gaussian[7 + b] = quantised(m.weights[b] / m.share);
  }
}

}  // namespace

NormalPyramid::NormalPyramid(const WeightPyramid& weights) : basis_(weights.channels()), levels_(weights.levels()) {
  std::size_t size = 0;
  for (int level = 0; level < levels(); ++level) {
    const Extent e = weights.extent(level);
    levels_[level] = {e, size};
    size += static_cast<std::size_t>(e.width) * e.height * texel_bytes(level);
  }
  data_.assign(size, 0);
}

std::span<std::uint8_t> NormalPyramid::row(int level, int y) {
  return {texel(level, 0, y), static_cast<std::size_t>(extent(level).width) * texel_bytes(level)};
}
std::span<const std::uint8_t> NormalPyramid::row(int level, int y) const {
  return const_cast<NormalPyramid*>(this)->row(level, y);
}

/// The Gaussians of a level before they are rounded: what the next level is merged from.
class NormalPyramid::Unrounded {
 public:
  Unrounded(Extent extent, int gaussians, int basis)
      : extent_(extent),
        gaussians_(gaussians),
        basis_(basis),
        values_(static_cast<std::size_t>(extent.width) * extent.height * gaussians * (kNormalMoments + basis)) {}
  int gaussians() const { return gaussians_; }
  Extent extent() const { return extent_; }
  void set(int x, int y, int gaussian, const Moments& m) {
    float* to = at(x, y, gaussian);
    for (float value : {m.share, m.x, m.y, m.xx, m.xy, m.yy}) *to++ = value;
    std::copy_n(m.weights.begin(), basis_, to);
  }
  /// A part of it.
  Moments get(int x, int y, int gaussian, float part) const {
    const float* v = const_cast<Unrounded*>(this)->at(x, y, gaussian);
    Moments m{part * v[0], part * v[1], part * v[2], part * v[3], part * v[4], part * v[5], {}};
    for (int b = 0; b < basis_; ++b) m.weights[b] = part * v[kNormalMoments + b];
    return m;
  }

 private:
  static constexpr int kNormalMoments = 6;
  float* at(int x, int y, int gaussian) {
    const std::size_t texel = static_cast<std::size_t>(y) * extent_.width + x;
    return &values_[(texel * gaussians_ + gaussian) * (kNormalMoments + basis_)];
  }

  Extent extent_;
  int gaussians_, basis_;
  std::vector<float> values_;
};

NormalPyramid::Unrounded NormalPyramid::store_base(const BaseLevel& moments, const WeightPyramid& weights) {
  Unrounded base(moments.extent, 1, basis_);
  parallel_for(moments.extent.height, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < moments.extent.width; ++x) {
      const std::size_t t = row * moments.extent.width + x;
      if (moments.coverage[t] <= 0) continue;
      const float* m = &moments.values[t * kMoments];
      const NormalGaussian normals = Moments{1, m[0], m[1], m[2], m[3], m[4], {}}.gaussian();
      const PackedNormals packed = pack(normals);
      std::copy(packed.bytes.begin(), packed.bytes.end(), texel(0, x, y));
      Moments part = moments_of(normals, moments.coverage[t]);
      for (int b = 0; b < basis_; ++b) part.weights[b] = part.share * weights.value(0, x, y, b) / weights.scales()[b];
      base.set(x, y, 0, part);
    }
  });
  return base;
}

NormalPyramid::Unrounded NormalPyramid::store_level(int level, const Unrounded& fine) {
  const Extent to = extent(level);
  const auto across = overlaps(fine.extent().width, to.width), down = overlaps(fine.extent().height, to.height);
  Unrounded coarse(to, kGaussians, basis_);
  parallel_for(to.height, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    MixtureReduction mixture(basis_);
    for (int x = 0; x < to.width; ++x) {
      mixture.clear();
      for (std::size_t j = 0; j < down[y].part.size(); ++j)
        for (std::size_t i = 0; i < across[x].part.size(); ++i)
          for (int g = 0; g < fine.gaussians(); ++g) {
            const Moments m = fine.get(across[x].first + static_cast<int>(i), down[y].first + static_cast<int>(j), g,
                                       down[y].part[j] * across[x].part[i]);
            if (m.share > 0) mixture.add(m);
          }
      mixture.reduce(kGaussians);
      for (int g = 0; g < mixture.size(); ++g) coarse.set(x, y, g, mixture.part(g));
      store(mixture, basis_, texel(level, x, y));
    }
  });
  return coarse;
}

NormalPyramid::NormalPyramid(const BaseLevel& moments, const WeightPyramid& weights) : NormalPyramid(weights) {
  if (moments.channels != kMoments || moments.extent != weights.extent(0))
    throw Error("normals: expected {} moments a texel of {}x{}, found {} of {}x{}", kMoments, weights.extent(0).width,
                weights.extent(0).height, moments.channels, moments.extent.width, moments.extent.height);
  Unrounded fine = store_base(moments, weights);
  for (int level = 1; level < levels(); ++level) fine = store_level(level, fine);
}

}  // namespace redmap
