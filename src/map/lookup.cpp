// Filtering a footprint out of a pyramid: the plan (where the taps are) and the taps. The anisotropic plan matches the
// variance of the footprint, docs/lookup.md; the isotropic one is section 5.3 of the paper.
#include <algorithm>
#include <bit>
#include <cmath>

#include "map/pyramid.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace redmap {
namespace {

/// Footprints longer than this are widened instead: 16 is what texture hardware does, and beyond it errors no longer
/// fall.
constexpr float kMaxAnisotropy = 16;
/// Distance of two taps in texels of their level, at most: with the tent and box of a tap, 1.5 leaves no ripple that
/// shows.
constexpr float kTapSpacing = 1.5f;
/// A bilinear tap on box-filtered texels of width c has variance c^2 / 12 + c^2 / 6 = c^2 / 4; a box of width m has
/// m^2 / 12. They match at c = m / sqrt 3.
constexpr float kTexelPerMinor = 0.57735027f;

/// Taps that kMaxAnisotropy and kTapSpacing lead to at most: 16 sqrt 3 / 1.5 + .5, rounded up.
constexpr int kMaxTaps = 19;
/// 1 / sqrt(n^2 - 1), the spacing of n taps of unit spread: looked up, since the square root would be waited for.
const std::array<float, kMaxTaps + 1> kTapSpread = [] {
  std::array<float, kMaxTaps + 1> spread{};
  for (int n = 2; n <= kMaxTaps; ++n) spread[n] = 1 / std::sqrt(static_cast<float>(n * n - 1));
  return spread;
}();

/// floor(log2(x)) for finite x >= 1.
int floor_log2(float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127; }

/// 2^exponent, for exponents of levels.
float power_of_two(int exponent) { return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23); }

bool is_finite(const Footprint& f) {
  return std::isfinite(f.uv.x + f.uv.y + f.duv_dx.x + f.duv_dx.y + f.duv_dy.x + f.duv_dy.y);
}

LookupPlan plan_variance_matched(const Footprint& footprint, Extent extent, int levels) {
  const FootprintAxes axes = footprint_axes(footprint, extent);
  const float texel = std::max(1.0f, kTexelPerMinor * std::max(axes.minor, axes.major / kMaxAnisotropy));

  // What the tap's own width leaves of the major axis is covered by n taps: variance h^2 (n^2 - 1) / 12 = rest^2 / 12.
  const float rest = std::sqrt(std::max(0.0f, axes.major * axes.major - 3 * texel * texel));
  LookupPlan plan;
  plan.first_uv = footprint.uv;
  if (rest > 0.5f * texel) {
    plan.taps = std::clamp(static_cast<int>(std::ceil(rest / (kTapSpacing * texel) + 0.5f)), 2, kMaxTaps);
    plan.step_uv = axes.major_direction_uv * (rest / axes.major * kTapSpread[plan.taps]);
    plan.first_uv = footprint.uv - plan.step_uv * (0.5f * static_cast<float>(plan.taps - 1));
  }

  // Between two levels the variances add up to that of the texel wanted: (1 - f) c0^2 + f (2 c0)^2 = c^2.
  plan.level = std::min(floor_log2(texel), std::max(0, levels - 2));
  const float ratio = texel * power_of_two(-plan.level);
  plan.coarse_part = levels > 1 ? std::clamp((ratio * ratio - 1) / 3, 0.0f, 1.0f) : 0.0f;
  return plan;
}

LookupPlan plan_enclosing_square(const Footprint& f, Extent extent, int levels) {
  const float across = (std::abs(f.duv_dx.x) + std::abs(f.duv_dy.x)) * static_cast<float>(extent.width);
  const float down = (std::abs(f.duv_dx.y) + std::abs(f.duv_dy.y)) * static_cast<float>(extent.height);
  const float level = std::clamp(std::log2(std::max({across, down, 1.0f})), 0.0f, static_cast<float>(levels - 1));
  LookupPlan plan;
  plan.first_uv = f.uv;
  plan.level = std::min(static_cast<int>(level), std::max(0, levels - 2));
  plan.coarse_part = level - static_cast<float>(plan.level);
  return plan;
}

/// Most taps: their weights need no coverage.
bool fully_covered(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) { return (a & b & c & d) == 255; }
bool fully_covered(float a, float b, float c, float d) { return a == 1 && b == 1 && c == 1 && d == 1; }

#ifdef __AVX2__

/// Eight floats, one register.
struct Lanes {
  __m256 v = _mm256_setzero_ps();
  static Lanes load(const float* p) { return {_mm256_loadu_ps(p)}; }
  static Lanes load(const std::uint8_t* p) {
    return {_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))))};
  }
  /// Two short chains rather than one long: the sum over the taps waits for one addition each.
  void add(const float (&w)[4], Lanes a, Lanes b, Lanes c, Lanes d) {
    const __m256 ab = _mm256_fmadd_ps(_mm256_set1_ps(w[1]), b.v, _mm256_mul_ps(_mm256_set1_ps(w[0]), a.v));
    const __m256 cd = _mm256_fmadd_ps(_mm256_set1_ps(w[3]), d.v, _mm256_mul_ps(_mm256_set1_ps(w[2]), c.v));
    v = _mm256_add_ps(v, _mm256_add_ps(ab, cd));
  }
  void store_scaled(float s, const float* scales, float* out) const {
    _mm256_store_ps(out, _mm256_mul_ps(_mm256_mul_ps(v, _mm256_load_ps(scales)), _mm256_set1_ps(s)));
  }
};

#else

/// Eight floats, for processors without AVX2.
struct Lanes {
  float v[kLanes] = {};
  template <typename Component>
  static Lanes load(const Component* p) {
    Lanes lanes;
    for (std::size_t i = 0; i < kLanes; ++i) lanes.v[i] = static_cast<float>(p[i]);
    return lanes;
  }
  void add(const float (&w)[4], Lanes a, Lanes b, Lanes c, Lanes d) {
    for (std::size_t i = 0; i < kLanes; ++i) v[i] += (w[0] * a.v[i] + w[1] * b.v[i]) + (w[2] * c.v[i] + w[3] * d.v[i]);
  }
  void store_scaled(float s, const float* scales, float* out) const {
    for (std::size_t i = 0; i < kLanes; ++i) out[i] = v[i] * scales[i] * s;
  }
};

#endif

}  // namespace

FootprintAxes footprint_axes(const Footprint& footprint, Extent extent) {
  const float width = static_cast<float>(extent.width), height = static_cast<float>(extent.height);
  const Vec2 x{footprint.duv_dx.x * width, footprint.duv_dx.y * height};
  const Vec2 y{footprint.duv_dy.x * width, footprint.duv_dy.y * height};

  // Larger eigenvalue and its vector of J J^T; the smaller singular value from the determinant, which stays precise.
  const float uu = x.x * x.x + y.x * y.x, uv = x.x * x.y + y.x * y.y, vv = x.y * x.y + y.y * y.y;
  const float half_difference = 0.5f * (uu - vv);
  const float root = std::sqrt(half_difference * half_difference + uv * uv);
  const float major = std::sqrt(0.5f * (uu + vv) + root);
  if (!(major > 0)) return {};
  Vec2 direction = half_difference >= 0 ? Vec2{half_difference + root, uv} : Vec2{uv, root - half_difference};
  const float norm = length(direction);
  direction = norm > 0 ? direction * (major / norm) : Vec2{major, 0};
  return {major, std::abs(cross(x, y)) / major, {direction.x / width, direction.y / height}};
}

LookupPlan plan_lookup(const Footprint& footprint, Extent extent, int levels, LookupFilter filter) {
  if (!is_finite(footprint)) return {{0.5f, 0.5f}, {}, 1, std::max(0, levels - 2), levels > 1 ? 1.0f : 0.0f};
  return filter == LookupFilter::kVarianceMatched ? plan_variance_matched(footprint, extent, levels)
                                                  : plan_enclosing_square(footprint, extent, levels);
}

template <typename Component>
struct Pyramid<Component>::Sum {
  float coverage = 0;
  Lanes chunk[2];
};

/// `uv.x` is in [0, 1] where u wraps.
template <typename Component>
template <int kChunks, bool kUseCoverage>
inline void Pyramid<Component>::add_tap(const Level& level, Vec2 uv, float part, Sum& sum) const {
  const float width = static_cast<float>(level.extent.width), height = static_cast<float>(level.extent.height);
  float x = uv.x * width - 0.5f;
  x = wraps_u_ ? x + (x < 0 ? width : 0.0f) : std::min(std::max(x, 0.0f), width - 1);
  const float y = std::min(std::max(uv.y * height - 0.5f, 0.0f), height - 1);
  const int x0 = std::min(static_cast<int>(x), level.extent.width - 1), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);

  // Two texels side by side, and the two below them.
  const int stride = texel_stride_;
  const Component* a = data_.data() + level.offset + y0 * level.row_stride + static_cast<std::size_t>(x0) * stride;
  const Component* c = y0 + 1 < level.extent.height ? a + level.row_stride : a;
  const float upper = part * (1 - fy), lower = part * fy;
  float weight[4] = {upper * (1 - fx), upper * fx, lower * (1 - fx), lower * fx};
  if (kUseCoverage && !fully_covered(a[0], a[stride], c[0], c[stride])) {
    weight[0] *= kComponentStep * static_cast<float>(a[0]), weight[1] *= kComponentStep * static_cast<float>(a[stride]);
    weight[2] *= kComponentStep * static_cast<float>(c[0]), weight[3] *= kComponentStep * static_cast<float>(c[stride]);
  }
  sum.coverage += (weight[0] + weight[1]) + (weight[2] + weight[3]);
  for (int i = 0; i < kChunks; ++i) {
    const int channel = 1 + i * static_cast<int>(kLanes);
    sum.chunk[i].add(weight, Lanes::load(a + channel), Lanes::load(a + stride + channel), Lanes::load(c + channel),
                     Lanes::load(c + stride + channel));
  }
}

template <typename Component>
template <int kChunks, bool kUseCoverage>
FilteredTexel Pyramid<Component>::gather(const LookupPlan& plan) const {
  const Level& fine = levels_[plan.level];
  const Level& coarse = levels_[plan.coarse_part > 0 ? plan.level + 1 : plan.level];
  Sum sum;
  for (int i = 0; i < plan.taps; ++i) {
    Vec2 uv = plan.first_uv + plan.step_uv * static_cast<float>(i);
    if (wraps_u_) uv.x -= std::floor(uv.x);
    if (plan.coarse_part < 1) add_tap<kChunks, kUseCoverage>(fine, uv, 1 - plan.coarse_part, sum);
    if (plan.coarse_part > 0) add_tap<kChunks, kUseCoverage>(coarse, uv, plan.coarse_part, sum);
  }
  // Both chunks are stored, so that nothing has to be cleared first.
  FilteredTexel result;
  result.coverage = kUseCoverage ? std::min(1.0f, sum.coverage / static_cast<float>(plan.taps)) : 0.0f;
  const float scale = sum.coverage > 0 ? kComponentStep / sum.coverage : 0.0f;
  for (int i = 0; i < 2; ++i) sum.chunk[i].store_scaled(scale, &scales_[i * kLanes], &result.channel[i * kLanes]);
  return result;
}

template <typename Component>
FilteredTexel Pyramid<Component>::filter(const LookupPlan& plan) const {
  const bool one_chunk = channels_ <= static_cast<int>(kLanes);
  const FilteredTexel texel = one_chunk ? gather<1, true>(plan) : gather<2, true>(plan);
  if (texel.coverage > 0) return texel;
  return one_chunk ? gather<1, false>(plan) : gather<2, false>(plan);
}

template <typename Component>
void Pyramid<Component>::prefetch(const LookupPlan& plan) const {
  Vec2 uv = plan.first_uv;
  if (wraps_u_) uv.x -= std::floor(uv.x);
  const int last = std::min(plan.level + 1, levels() - 1);
  for (int l = plan.level; l <= last; ++l) {
    const Level& level = levels_[l];
    const auto clamped = [](float value, int size) { return std::clamp(static_cast<int>(value), 0, size - 1); };
    const int x = clamped(uv.x * static_cast<float>(level.extent.width) - 0.5f, level.extent.width);
    const int y = clamped(uv.y * static_cast<float>(level.extent.height) - 0.5f, level.extent.height);
    const Component* at = texel(l, x, y);
    __builtin_prefetch(at);
    __builtin_prefetch(at + level.row_stride);
  }
}

template <typename Component>
FilteredTexel Pyramid<Component>::lookup(const Footprint& footprint, LookupFilter how) const {
  return filter(plan_lookup(footprint, extent(0), levels(), how));
}

template <typename Component>
void Pyramid<Component>::lookup(std::span<const Footprint> footprints, LookupFilter how,
                                std::span<FilteredTexel> out) const {
  std::array<LookupPlan, kLookupBatch> plans;
  for (std::size_t first = 0; first < footprints.size(); first += kLookupBatch) {
    const std::size_t count = std::min(kLookupBatch, footprints.size() - first);
    // All texels are asked for before the first is waited for.
    for (std::size_t i = 0; i < count; ++i) {
      plans[i] = plan_lookup(footprints[first + i], extent(0), levels(), how);
      prefetch(plans[i]);
    }
    for (std::size_t i = 0; i < count; ++i) out[first + i] = filter(plans[i]);
  }
}

template class Pyramid<std::uint8_t>;
template class Pyramid<float>;

}  // namespace redmap
