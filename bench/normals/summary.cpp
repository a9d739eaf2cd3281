#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "cases.h"

namespace redmap::bench {

namespace {

bool same_case(const NormalsRow& a, const NormalsRow& b) {
  return a.object == b.object && a.bump == b.bump && a.gloss == b.gloss && a.minification == b.minification;
}

bool is_map(const NormalsRow& row) { return row.method == "map" && row.quality == "default"; }

/// The map's row and another method's, in every case that has both.
struct Pair {
  const NormalsRow *map, *other;
};
std::vector<Pair> pairs_with(std::span<const NormalsRow> rows, const std::string& method, int spp) {
  std::vector<Pair> pairs;
  for (const NormalsRow& map : rows) {
    if (!is_map(map)) continue;
    const auto other = std::find_if(rows.begin(), rows.end(), [&](const NormalsRow& row) {
      return row.method == method && row.spp == spp && same_case(row, map);
    });
    if (other != rows.end()) pairs.push_back({&map, &*other});
  }
  return pairs;
}

using Measure = std::function<std::optional<double>(const NormalsRow&)>;

/// Geometric mean of the map's measure over the other's.
std::optional<double> mean_ratio(const std::vector<Pair>& pairs, const Measure& measure) {
  double sum = 0, count = 0;
  for (const Pair& pair : pairs) {
    const std::optional<double> map = measure(*pair.map), other = measure(*pair.other);
    if (map && other && *map > 0 && *other > 0) sum += std::log(*map / *other), ++count;
  }
  return count > 0 ? std::optional(std::exp(sum / count)) : std::nullopt;
}

std::optional<double> win_rate(const std::vector<Pair>& pairs) {
  if (pairs.empty()) return std::nullopt;
  const auto wins = std::count_if(pairs.begin(), pairs.end(),
                                  [](const Pair& p) { return p.map->relative_rmse <= p.other->relative_rmse; });
  return static_cast<double>(wins) / static_cast<double>(pairs.size());
}

std::optional<double> mean_calls(std::span<const NormalsRow> rows) {
  double sum = 0, count = 0;
  for (const NormalsRow& row : rows)
    if (is_map(row) && is_single_basis(row.bump)) sum += row.shader_calls_per_lookup, ++count;
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

void find_worst(const std::vector<Pair>& pairs, NormalsSummary& summary) {
  for (const Pair& pair : pairs) {
    const double ratio = pair.map->relative_rmse / pair.other->relative_rmse;
    if (summary.worst_over_64spp && ratio <= *summary.worst_over_64spp) continue;
    summary.worst_over_64spp = ratio;
    summary.worst_case =
        fmt::format("{} {} {} at {:g}", pair.map->object, pair.map->bump, pair.map->gloss, pair.map->minification);
  }
}

}  // namespace

NormalsSummary summarize(std::span<const NormalsRow> rows) {
  const auto with_16 = pairs_with(rows, "supersample", 16), with_64 = pairs_with(rows, "supersample", 64);
  const Measure rmse = [](const NormalsRow& row) { return std::optional(row.relative_rmse); };
  const Measure time = [](const NormalsRow& row) { return std::optional(row.microseconds_per_pixel); };
  NormalsSummary summary;
  summary.map_over_16spp_rmse = mean_ratio(with_16, rmse);
  summary.map_over_64spp_rmse = mean_ratio(with_64, rmse);
  summary.map_over_paper_rmse = mean_ratio(pairs_with(rows, "paper", 0), rmse);
  summary.map_over_parameters_rmse = mean_ratio(pairs_with(rows, "parameters", 0), rmse);
  summary.map_over_64spp_flicker = mean_ratio(with_64, [](const NormalsRow& row) { return row.flicker; });
  summary.map_over_64spp_flicker_slow = mean_ratio(with_64, [](const NormalsRow& row) { return row.flicker_slow; });
  summary.map_over_16spp_microseconds = mean_ratio(with_16, time);
  summary.map_over_64spp_microseconds = mean_ratio(with_64, time);
  summary.calls_single_basis = mean_calls(rows);
  summary.win_rate_against_64spp = win_rate(with_64);
  summary.win_rate_against_16spp = win_rate(with_16);
  find_worst(with_64, summary);
  return summary;
}

}  // namespace redmap::bench
