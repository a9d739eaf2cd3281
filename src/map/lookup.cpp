// Filtering a footprint out of a pyramid: the taps that its plan (map/lookup_plan.cpp) asks for.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/lanes_math.h"
#include "map/pyramid.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace redmap {
namespace {

/// Most taps: their weights need no coverage.
bool fully_covered(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) { return (a & b & c & d) == 255; }
bool fully_covered(float a, float b, float c, float d) { return a == 1 && b == 1 && c == 1 && d == 1; }

lanes::Float load_lanes(const float* from) { return lanes::load(from); }
lanes::Float load_lanes(const std::uint8_t* from) {
#ifdef __AVX2__
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  return (lanes::FloatRegister)_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(bytes));
#else
  lanes::Float values;
  for (std::size_t i = 0; i < kLanes; ++i) values.v[i] = static_cast<float>(from[i]);
  return values;
#endif
}

/// The first half of the lanes from `fine`, the second from `coarse`.
lanes::Float halves(int fine, int coarse) {
  const float f = static_cast<float>(fine), c = static_cast<float>(coarse);
  return lanes::FloatRegister{f, f, f, f, c, c, c, c};
}

}  // namespace

/// Four taps, made ready together on two levels: lanes 0 to 3 on the finer one, 4 to 7 on the coarser.
template <typename Component>
struct Pyramid<Component>::TapBlock {
  static constexpr int kTaps = kLanes / 2;

  alignas(32) std::array<float, kLanes> weight[4];  ///< of two texels side by side, and of the two below them
  alignas(32) std::array<float, kLanes> total;      ///< of the four weights
  alignas(32) std::array<std::int32_t, kLanes> x, y;
};

template <typename Component>
struct Pyramid<Component>::Sum {
  float coverage = 0;
  lanes::Float upper[2] = {0.0f, 0.0f}, lower[2] = {0.0f, 0.0f};  ///< rows apart: half as long a chain of additions
};

template <typename Component>
inline void Pyramid<Component>::place_taps(const LookupPlan& plan, int first, const Level& fine, const Level& coarse,
                                           TapBlock& block) const {
  using lanes::Float;
  const Float index = Float(static_cast<float>(first)) + lanes::FloatRegister{0, 1, 2, 3, 0, 1, 2, 3};
  const Float width = halves(fine.extent.width, coarse.extent.width);
  const Float height = halves(fine.extent.height, coarse.extent.height);

  Float u = Float(plan.first_uv.x) + Float(plan.step_uv.x) * index;
  if (wraps_u_) u = u - lanes::floor(u);
  Float x = u * width - 0.5f;
  if (wraps_u_) x = lanes::select(x < 0.0f, x + width, x);
  x = lanes::clamp(x, 0.0f, wraps_u_ ? width : width - 1.0f);
  const Float y =
      lanes::clamp((Float(plan.first_uv.y) + Float(plan.step_uv.y) * index) * height - 0.5f, 0.0f, height - 1.0f);
  const Float left = lanes::min(lanes::floor(x), width - 1.0f), top = lanes::floor(y);
  const lanes::Int x0(left), y0(top);
  std::memcpy(block.x.data(), &x0.v, sizeof x0.v);
  std::memcpy(block.y.data(), &y0.v, sizeof y0.v);

  const Float part = lanes::FloatRegister{1, 1, 1, 1, 0, 0, 0, 0} +
                     lanes::FloatRegister{-1, -1, -1, -1, 1, 1, 1, 1} * Float(plan.coarse_part).v;
  const Float right_part = x - left, lower = part * (y - top), upper = part - lower;
  const Float weight[4] = {upper - upper * right_part, upper * right_part, lower - lower * right_part,
                           lower * right_part};
  for (int i = 0; i < 4; ++i) lanes::store(block.weight[i].data(), weight[i]);
  lanes::store(block.total.data(), (weight[0] + weight[1]) + (weight[2] + weight[3]));
}

/// The last row's texels have nothing but zero weights below them: what is read there does not matter.
template <typename Component>
template <int kChunks, bool kUseCoverage>
inline void Pyramid<Component>::add_tap(const Level& level, int lane, TapBlock& block, Sum& sum) const {
  const int stride = texel_stride_;
  const Component* a =
      data_.data() + level.offset + block.y[lane] * level.row_stride + static_cast<std::size_t>(block.x[lane]) * stride;
  const Component* c = a + level.row_stride;
  auto& weight = block.weight;
  if (kUseCoverage && !fully_covered(a[0], a[stride], c[0], c[stride])) {
    weight[0][lane] *= kComponentStep * static_cast<float>(a[0]);
    weight[1][lane] *= kComponentStep * static_cast<float>(a[stride]);
    weight[2][lane] *= kComponentStep * static_cast<float>(c[0]);
    weight[3][lane] *= kComponentStep * static_cast<float>(c[stride]);
    block.total[lane] = (weight[0][lane] + weight[1][lane]) + (weight[2][lane] + weight[3][lane]);
  }
  sum.coverage += block.total[lane];
  for (int i = 0; i < kChunks; ++i) {
    const int channel = 1 + i * static_cast<int>(kLanes);
    sum.upper[i] += lanes::Float(weight[0][lane]) * load_lanes(a + channel);
    sum.lower[i] += lanes::Float(weight[2][lane]) * load_lanes(c + channel);
    sum.upper[i] += lanes::Float(weight[1][lane]) * load_lanes(a + stride + channel);
    sum.lower[i] += lanes::Float(weight[3][lane]) * load_lanes(c + stride + channel);
  }
}

template <typename Component>
template <int kChunks, bool kUseCoverage>
FilteredTexel Pyramid<Component>::gather(const LookupPlan& plan) const {
  const Level& fine = levels_[plan.level];
  const Level& coarse = levels_[plan.coarse_part > 0 ? plan.level + 1 : plan.level];
  Sum sum;
  TapBlock block;
  for (int first = 0; first < plan.taps; first += TapBlock::kTaps) {
    place_taps(plan, first, fine, coarse, block);
    const int taps = std::min(TapBlock::kTaps, plan.taps - first);
    if (plan.coarse_part < 1)
      for (int i = 0; i < taps; ++i) add_tap<kChunks, kUseCoverage>(fine, i, block, sum);
    if (plan.coarse_part > 0)
      for (int i = 0; i < taps; ++i) add_tap<kChunks, kUseCoverage>(coarse, TapBlock::kTaps + i, block, sum);
  }
  // Both chunks are stored, so that nothing has to be cleared first.
  FilteredTexel result;
  result.coverage = kUseCoverage ? std::min(1.0f, sum.coverage / static_cast<float>(plan.taps)) : 0.0f;
  const lanes::Float scale = sum.coverage > 0 ? kComponentStep / sum.coverage : 0.0f;
  for (int i = 0; i < 2; ++i)
    lanes::store(&result.channel[i * kLanes],
                 (sum.upper[i] + sum.lower[i]) * lanes::load(&scales_[i * kLanes]) * scale);
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
    const auto some = std::span(plans).first(count);
    plan_lookups(footprints.subspan(first, count), extent(0), levels(), how, some);
    for (const LookupPlan& plan : some) prefetch(plan);
    for (std::size_t i = 0; i < count; ++i) out[first + i] = filter(plans[i]);
  }
}

template class Pyramid<std::uint8_t>;
template class Pyramid<float>;

}  // namespace redmap
