// Pyramids: what reduction keeps, what the lookup answers, and that the fast lookup is the slow one.
#include "map/pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

namespace redmap {
namespace {

/// Random values; about a tenth of the texels are bare, another tenth partly covered.
BaseLevel random_base(Extent extent, int channels, bool wraps_u, std::uint64_t seed) {
  BaseLevel base(extent, channels, wraps_u);
  Random random(seed);
  for (float& v : base.values) v = 1.7f * random.next_float();
  for (float& c : base.coverage) {
    const float r = random.next_float();
    c = r < 0.1f ? 0.0f : r < 0.2f ? random.next_float() : 1.0f;
  }
  return base;
}

Footprint square_footprint(Vec2 uv, float side_uv) { return {uv, {side_uv, 0}, {0, side_uv}}; }

Footprint random_footprint(Random& random, float largest_uv) {
  const auto step = [&] { return largest_uv * std::pow(random.next_float(), 3.0f) * (random.next_float() - 0.5f); };
  return {{2 * random.next_float() - 0.5f, 1.2f * random.next_float() - 0.1f}, {step(), step()}, {step(), step()}};
}

/// The lookup as docs/lookup.md writes it down, in double precision, texel by texel.
template <typename Component>
struct SlowLookup {
  const Pyramid<Component>& pyramid;
  double coverage = 0;
  std::vector<double> channel = std::vector<double>(kMaxChannels);

  void texel(int level, long x, long y, double weight) {
    const Extent e = pyramid.extent(level);
    x = pyramid.wraps_u() ? ((x % e.width) + e.width) % e.width : std::clamp<long>(x, 0, e.width - 1);
    y = std::clamp<long>(y, 0, e.height - 1);
    const double covered = weight * pyramid.coverage(level, static_cast<int>(x), static_cast<int>(y));
    coverage += covered;
    for (int c = 0; c < pyramid.channels(); ++c)
      channel[c] += covered * pyramid.value(level, static_cast<int>(x), static_cast<int>(y), c);
  }
  void tap(int level, double u, double v, double weight) {
    const double x = u * pyramid.extent(level).width - 0.5, y = v * pyramid.extent(level).height - 0.5;
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        texel(level, std::lround(std::floor(x)) + i, std::lround(std::floor(y)) + j,
              weight * (i ? fx : 1 - fx) * (j ? fy : 1 - fy));
  }
  void run(const LookupPlan& plan) {
    for (int i = 0; i < plan.taps; ++i) {
      const double u = plan.first_uv.x + i * static_cast<double>(plan.step_uv.x);
      const double v = plan.first_uv.y + i * static_cast<double>(plan.step_uv.y);
      tap(plan.level, u, v, (1.0 - plan.coarse_part) / plan.taps);
      if (plan.coarse_part > 0) tap(plan.level + 1, u, v, static_cast<double>(plan.coarse_part) / plan.taps);
    }
  }
};

template <typename Component>
void expect_fast_equals_slow(Extent extent, int channels, bool wraps_u, LookupFilter filter) {
  const Pyramid<Component> pyramid(random_base(extent, channels, wraps_u, 7));
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Footprint footprint = random_footprint(random, 1.0f);
    SlowLookup<Component> slow{pyramid};
    slow.run(plan_lookup(footprint, extent, pyramid.levels(), filter));
    const FilteredTexel fast = pyramid.lookup(footprint, filter);
    ASSERT_NEAR(fast.coverage, slow.coverage, 1e-5);
    // 1e-5 of the largest value; what divides by the coverage is the same on both sides.
    for (int c = 0; c < channels; ++c)
      ASSERT_NEAR(fast.channel[c] * slow.coverage, slow.channel[c], 1.7e-5) << "channel " << c << ", footprint " << i;
    for (int c = channels; c < kMaxChannels; ++c) ASSERT_EQ(fast.channel[c], 0);
  }
}

TEST(Lookup, Fast_EqualsSlow_ForBytesAndFloatsOfAnyWidth) {
  for (int channels : {1, 3, 4, 8, 9, 16})
    for (bool wraps : {false, true}) {
      expect_fast_equals_slow<std::uint8_t>({64, 64}, channels, wraps, LookupFilter::kVarianceMatched);
      expect_fast_equals_slow<float>({128, 64}, channels, wraps, LookupFilter::kVarianceMatched);
    }
  expect_fast_equals_slow<std::uint8_t>({64, 32}, 3, true, LookupFilter::kEnclosingSquare);
  expect_fast_equals_slow<float>({60, 90}, 2, false, LookupFilter::kEnclosingSquare);
}

TEST(Lookup, Batch_EqualsSingle_BitForBit) {
  for (int channels : {3, 16}) {
    const Pyramid<std::uint8_t> pyramid(random_base({128, 64}, channels, true, 17));
    Random random(19);
    std::vector<Footprint> footprints(3 * kLookupBatch + 5);
    for (Footprint& f : footprints) f = random_footprint(random, 1.0f);
    for (LookupFilter how : {LookupFilter::kVarianceMatched, LookupFilter::kEnclosingSquare}) {
      std::vector<FilteredTexel> batch(footprints.size());
      pyramid.lookup(footprints, how, batch);
      for (std::size_t i = 0; i < footprints.size(); ++i) {
        const FilteredTexel single = pyramid.lookup(footprints[i], how);
        ASSERT_EQ(batch[i].coverage, single.coverage);
        ASSERT_EQ(batch[i].channel, single.channel);
      }
    }
  }
}

TEST(Lookup, FootprintBelowATexel_ReadsTheBaseBilinearly) {
  BaseLevel base({4, 4}, 1, false);
  for (int i = 0; i < 16; ++i) base.values[i] = static_cast<float>(i), base.coverage[i] = 1;
  const Pyramid<float> pyramid(base);
  EXPECT_FLOAT_EQ(pyramid.lookup(square_footprint({0.5f, 0.5f}, 0.01f)).channel[0], 7.5f);
  EXPECT_FLOAT_EQ(pyramid.lookup(square_footprint({0.125f, 0.125f}, 0.0f)).channel[0], 0.0f);
  EXPECT_FLOAT_EQ(pyramid.lookup(square_footprint({0.375f, 0.125f}, 0.0f)).channel[0], 1.0f);
}

TEST(Lookup, Deep_EqualsTheAverageOverTheFootprint_WithinABound) {
  // Noise of one texel: what is left after filtering is small, so that a wrong place or size would show.
  const Extent extent{256, 256};
  BaseLevel base(extent, 1, true);
  Random random(3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const float wave = std::sin(static_cast<float>(x) * 2 * kPi / 128) * std::sin(static_cast<float>(y) * kPi / 80);
      base.values[y * 256 + x] = 1 + wave + 0.5f * (random.next_float() - 0.5f);
    }
  std::fill(base.coverage.begin(), base.coverage.end(), 1.0f);
  const Pyramid<float> pyramid(base);
  double square_error = 0;
  const int lookups = 400;
  for (int i = 0; i < lookups; ++i) {
    const float side = 8 + 24 * random.next_float(), stretch = 1 + 3 * random.next_float();
    const float angle = 2 * kPi * random.next_float();
    const Vec2 along{std::cos(angle), std::sin(angle)};
    const Footprint f{{random.next_float(), 0.3f + 0.4f * random.next_float()},
                      along * (side * stretch / 256),
                      Vec2{-along.y, along.x} * (side / 256)};
    double mean = 0;
    const int n = 64;
    for (int j = 0; j < n * n; ++j) {
      const Vec2 at = f.uv + f.duv_dx * ((static_cast<float>(j % n) + 0.5f) / n - 0.5f) +
                      f.duv_dy * ((static_cast<float>(j / n) + 0.5f) / n - 0.5f);
      const int x = static_cast<int>(std::floor(at.x * 256)) & 255;
      const int y = std::clamp(static_cast<int>(std::floor(at.y * 256)), 0, 255);
      mean += base.values[y * 256 + x];
    }
    const double error = pyramid.lookup(f).channel[0] - mean / (n * n);
    square_error += error * error;
  }
  EXPECT_LT(std::sqrt(square_error / lookups), 0.02);
}

TEST(Lookup, PlannedTaps_HaveTheVarianceOfTheFootprint) {
  const Extent extent{1024, 1024};
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const float minor = 2 + 30 * random.next_float(), major = minor * (1.2f + 14 * random.next_float());
    const float angle = 2 * kPi * random.next_float();
    const Vec2 along{std::cos(angle), std::sin(angle)};
    const Footprint f{{0.5f, 0.5f}, along * (major / 1024), Vec2{-along.y, along.x} * (minor / 1024)};
    const LookupPlan plan = plan_lookup(f, extent, 11, LookupFilter::kVarianceMatched);
    const double texel = std::ldexp(1.0, plan.level), n = plan.taps;
    const double tap_variance = texel * texel / 4 * (1 - plan.coarse_part) + texel * texel * plan.coarse_part;
    const double step = 1024.0 * length(plan.step_uv);
    EXPECT_NEAR(tap_variance, minor * minor / 12, 1e-4 * minor * minor);
    EXPECT_NEAR(tap_variance + step * step * (n * n - 1) / 12, major * major / 12, 1e-3 * major * major);
    EXPECT_LE(step, 1.5 * texel * 2);
    EXPECT_NEAR(plan.first_uv.x + plan.step_uv.x * (n - 1) / 2, 0.5, 1e-5);
  }
}

TEST(Lookup, FootprintAxes_AreTheSingularValues_InTexels) {
  const FootprintAxes axes = footprint_axes({{0, 0}, {0.25f, 0}, {0, 0.5f}}, {200, 100});
  EXPECT_FLOAT_EQ(axes.major, 50);
  EXPECT_FLOAT_EQ(axes.minor, 50);
  const FootprintAxes sheared = footprint_axes({{0, 0}, {0.03f, 0.03f}, {0.01f, 0.01f}}, {100, 100});
  EXPECT_NEAR(sheared.major, std::sqrt(20.0), 1e-5);
  EXPECT_NEAR(sheared.minor, 0, 1e-6);
  EXPECT_NEAR(length(sheared.major_direction_uv), std::sqrt(20.0) / 100, 1e-7);
  EXPECT_EQ(footprint_axes({}, {100, 100}).major, 0);
}

TEST(Lookup, WildFootprints_StayInside) {
  const Pyramid<std::uint8_t> pyramid(random_base({64, 32}, 5, true, 2));
  const float wild[] = {0, -0.0f, 1, 1e-30f, 1e30f, -1e30f, 3e38f, std::numeric_limits<float>::infinity(), NAN, -1e-9f};
  for (float u : wild)
    for (float v : wild)
      for (float d : wild)
        for (float e : wild)
          for (LookupFilter filter : {LookupFilter::kVarianceMatched, LookupFilter::kEnclosingSquare}) {
            const FilteredTexel texel = pyramid.lookup({{u, v}, {d, e}, {e, -d}}, filter);
            for (int c = 0; c < 5; ++c) {
              ASSERT_GE(texel.channel[c], 0);
              ASSERT_LE(texel.channel[c], 1.71f);
            }
          }
}

TEST(Lookup, Seam_IsCrossedWhereUWraps_AndNotWhereItDoesNot) {
  for (bool wraps : {false, true}) {
    BaseLevel base({8, 8}, 1, wraps);
    for (int i = 0; i < 64; ++i) base.values[i] = i % 8 == 7 ? 1.0f : 0.0f, base.coverage[i] = 1;
    EXPECT_FLOAT_EQ(Pyramid<float>(base).lookup(square_footprint({0, 0.5f}, 0)).channel[0], wraps ? 0.5f : 0.0f);
    EXPECT_FLOAT_EQ(Pyramid<float>(base).lookup(square_footprint({1, 0.5f}, 0)).channel[0], wraps ? 0.5f : 1.0f);
    EXPECT_FLOAT_EQ(Pyramid<float>(base).lookup(square_footprint({-3, 0.5f}, 0)).channel[0], wraps ? 0.5f : 0.0f);
  }
}

TEST(Pyramid, Constants_StayConstantOnEveryLevel_WhateverTheCoverage) {
  for (Extent extent : {Extent{64, 64}, Extent{128, 64}, Extent{50, 27}, Extent{1, 9}}) {
    BaseLevel base = random_base(extent, 3, false, 21);
    for (std::size_t i = 0; i < base.values.size(); ++i) base.values[i] = base.coverage[i / 3] > 0 ? 0.37f : 9.0f;
    const Pyramid<std::uint8_t> bytes(base);
    const Pyramid<float> floats(base);
    for (int level = 0; level < bytes.levels(); ++level)
      for (int y = 0; y < bytes.extent(level).height; ++y)
        for (int x = 0; x < bytes.extent(level).width; ++x)
          for (int c = 0; c < 3; ++c) {
            ASSERT_FLOAT_EQ(bytes.value(level, x, y, c), 0.37f);
            ASSERT_NEAR(floats.value(level, x, y, c), 0.37f, 1e-6f);
          }
    EXPECT_EQ(bytes.extent(bytes.levels() - 1), (Extent{1, 1}));
  }
}

TEST(Pyramid, TopTexel_IsTheCoverageWeightedMean_ForOddSizesToo) {
  for (Extent extent : {Extent{64, 64}, Extent{128, 64}, Extent{50, 27}, Extent{7, 1}}) {
    const BaseLevel base = random_base(extent, 2, false, 31);
    double sum = 0, covered = 0;
    for (std::size_t t = 0; t < base.coverage.size(); ++t) {
      sum += static_cast<double>(base.coverage[t]) * base.values[2 * t + 1];
      covered += base.coverage[t];
    }
    const Pyramid<float> pyramid(base);
    const int top = pyramid.levels() - 1;
    EXPECT_NEAR(pyramid.value(top, 0, 0, 1), sum / covered, 1e-4);
    EXPECT_NEAR(pyramid.coverage(top, 0, 0), covered / static_cast<double>(base.coverage.size()), 1e-4);
  }
}

TEST(Pyramid, TwoCharts_DoNotLeak_ThroughTheGapBetweenThem) {
  // The charts hold 0 and 1 with four bare texels between them: up to level 2 no texel holds parts of both.
  BaseLevel base({64, 64}, 1, false);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      base.coverage[y * 64 + x] = x < 28 || x >= 36 ? 1.0f : 0.0f;
      base.values[y * 64 + x] = x >= 36 ? 1.0f : 0.0f;
    }
  const Pyramid<std::uint8_t> pyramid(base);
  for (int level = 0; level < 3; ++level) {
    const int width = pyramid.extent(level).width;
    for (int x = 0; x < width; ++x)
      if (pyramid.coverage(level, x, 0) > 0) {
        EXPECT_EQ(pyramid.value(level, x, 0, 0), x * 2 >= width ? 1.0f : 0.0f) << "level " << level << ", x " << x;
      }
  }
  for (float texels : {0.5f, 1.0f, 2.0f, 4.0f}) {
    EXPECT_EQ(pyramid.lookup(square_footprint({27.5f / 64, 0.5f}, texels / 64)).channel[0], 0);
    EXPECT_FLOAT_EQ(pyramid.lookup(square_footprint({36.5f / 64, 0.5f}, texels / 64)).channel[0], 1);
  }
}

TEST(Pyramid, BareTexels_ArePulledIn_AndReportNoCoverage) {
  BaseLevel base({32, 32}, 1, false);
  base.coverage[0] = 1, base.values[0] = 0.5f;
  const Pyramid<std::uint8_t> pyramid(base);
  const FilteredTexel far = pyramid.lookup(square_footprint({0.9f, 0.9f}, 0));
  EXPECT_EQ(far.coverage, 0);
  EXPECT_FLOAT_EQ(far.channel[0], 0.5f);
  EXPECT_GT(pyramid.coverage(pyramid.levels() - 1, 0, 0), 0);
}

TEST(Pyramid, IsTheSame_ForAnyNumberOfThreads) {
  const BaseLevel base = random_base({100, 75}, 6, true, 9);
  std::vector<std::uint8_t> first;
  for (std::size_t threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const Pyramid<std::uint8_t> pyramid(base);
    std::vector<std::uint8_t> all;
    for (int level = 0; level < pyramid.levels(); ++level)
      for (int y = 0; y < pyramid.extent(level).height; ++y) {
        const auto row = pyramid.row(level, y);
        all.insert(all.end(), row.begin(), row.end());
      }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  }
}

TEST(Pyramid, RefusesWhatDoesNotFit) {
  EXPECT_THROW(Pyramid<float>(BaseLevel({0, 4}, 1, false)), Error);
  EXPECT_THROW(Pyramid<float>(BaseLevel({4, 4}, 0, false)), Error);
  EXPECT_THROW(Pyramid<float>(BaseLevel({4, 4}, 17, false)), Error);
  BaseLevel base({4, 4}, 2, false);
  base.values.pop_back();
  EXPECT_THROW(Pyramid<float>{base}, Error);
}

}  // namespace
}  // namespace redmap
