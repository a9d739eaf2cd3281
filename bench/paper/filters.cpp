// Isotropic against anisotropic footprints: how far lookups are from the average of the texels that they stand for.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "figures.h"

namespace redmap::bench {

namespace {

/// Texels across the footprint's minor axis, and points a side that its average is taken from.
constexpr float kMinor = 4;
constexpr int kPoints = 64;

/// Level 0 of channel 0 averaged over the footprint, point by point.
double average_of(const WeightPyramid& map, const Footprint& footprint) {
  const Extent extent = map.extent(0);
  double sum = 0;
  for (int j = 0; j < kPoints * kPoints; ++j) {
    const Vec2 at = footprint.uv + footprint.duv_dx * ((static_cast<float>(j % kPoints) + 0.5f) / kPoints - 0.5f) +
                    footprint.duv_dy * ((static_cast<float>(j / kPoints) + 0.5f) / kPoints - 0.5f);
    const float u = at.x - std::floor(at.x);
    const int x = std::min(static_cast<int>(u * static_cast<float>(extent.width)), extent.width - 1);
    const int y = std::clamp(static_cast<int>(at.y * static_cast<float>(extent.height)), 0, extent.height - 1);
    sum += map.value(0, x, y, 0);
  }
  return sum / (kPoints * kPoints);
}

struct FilterErrors {
  double enclosing_square = 0, isotropic = 0, matched = 0, taps = 0;
};

/// Root mean square errors over random footprints of that anisotropy; the isotropic ones have the same area.
FilterErrors measure_errors_of(const WeightPyramid& map, float anisotropy, int lookups) {
  const Extent extent = map.extent(0);
  const auto w = static_cast<float>(extent.width), h = static_cast<float>(extent.height);
  Random random(17);
  FilterErrors sums;
  for (int i = 0; i < lookups; ++i) {
    const float angle = 2 * kPi * random.next_float(), major = kMinor * anisotropy;
    const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
    const Vec2 uv{random.next_float(), 0.2f + 0.6f * random.next_float()};
    const Footprint footprint{
        uv, {along.x * major / w, along.y * major / h}, {across.x * kMinor / w, across.y * kMinor / h}};
    const float side = kMinor * std::sqrt(anisotropy);
    const Footprint square{uv, {side / w, 0}, {0, side / h}};
    const double truth = average_of(map, footprint);
    const auto squared = [&](const Footprint& f, LookupFilter filter) {
      const double error = map.lookup(f, filter).channel[0] - truth;
      return error * error;
    };
    sums.enclosing_square += squared(footprint, LookupFilter::kEnclosingSquare);
    sums.isotropic += squared(square, LookupFilter::kVarianceMatched);
    sums.matched += squared(footprint, LookupFilter::kVarianceMatched);
    sums.taps += plan_lookup(footprint, extent, map.levels(), LookupFilter::kVarianceMatched).taps;
  }
  const auto root = [&](double sum) { return std::sqrt(sum / lookups); };
  return {root(sums.enclosing_square), root(sums.isotropic), root(sums.matched), sums.taps / lookups};
}

}  // namespace

Figure measure_filters(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Isotropic against anisotropic footprints";
  figure.paper =
      "The square that encloses the footprint, trilinear; \"could easily be extended to use footprint assembly\".";
  figure.ours =
      "Weights of noise on the sphere, looked up for random footprints four texels across, against the average of the "
      "texels under them. One unit is a whole weight.";
  Table table{"footprints",
              "Root mean square error of a lookup",
              {{"anisotropy", "anisotropy"},
               {"enclosing_square", "enclosing square, trilinear (the paper)"},
               {"isotropic", "square of the same area"},
               {"matched", "variance-matched, anisotropic (ours)"},
               {"paper_over_ours", "the paper's / ours"},
               {"taps", "taps of ours"}},
              {}};
  const BakedTexture texture = laboratory.baked("sphere", "noise");
  const WeightPyramid& map = texture.map().weights;
  Plot plot{"footprints",
            "Error of a lookup",
            "anisotropy",
            "RMSE",
            {{"enclosing square", {}, true}, {"square of the same area", {}, true}, {"variance-matched", {}, true}}};
  bool below = true;
  for (const float anisotropy : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
    laboratory.step(std::log2(anisotropy) / 5);
    const FilterErrors errors = measure_errors_of(map, anisotropy, laboratory.samples(4000, 500));
    table.rows.push_back({static_cast<double>(anisotropy), errors.enclosing_square, errors.isotropic, errors.matched,
                          errors.enclosing_square / errors.matched, errors.taps});
    plot.series[0].points.push_back({anisotropy, errors.enclosing_square});
    plot.series[1].points.push_back({anisotropy, errors.isotropic});
    plot.series[2].points.push_back({anisotropy, errors.matched});
    below = below && errors.matched <= errors.enclosing_square;
  }
  figure.tables.push_back(std::move(table));
  figure.plots.push_back(std::move(plot));
  figure.claims.push_back({"ours below the enclosing square at every anisotropy", below ? "all" : "not all", below});
  return figure;
}

}  // namespace redmap::bench
