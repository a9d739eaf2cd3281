// Rows of `redmap bench normals` in a few numbers: ratios of methods, geometric means over cases.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "normals.h"

namespace redmap::bench {

/// Ratios are the map's (default quality) over the other method's in the same case; below 1 the map is better. Empty
/// where no case has both.
struct NormalsSummary {
  std::optional<double> map_over_16spp_rmse, map_over_64spp_rmse, map_over_paper_rmse, map_over_parameters_rmse;
  std::optional<double> map_over_64spp_flicker, map_over_64spp_flicker_slow;
  std::optional<double> map_over_16spp_microseconds, map_over_64spp_microseconds;
  std::optional<double> calls_single_basis;      ///< mean shader calls a lookup where one basis is enough
  std::optional<double> win_rate_against_64spp;  ///< part of the cases with no larger RMSE
  std::optional<double> win_rate_against_16spp;
  std::optional<double> worst_over_64spp;  ///< largest ratio of RMSE
  std::string worst_case;                  ///< and where
};

NormalsSummary summarize(std::span<const NormalsRow> rows);

}  // namespace redmap::bench
