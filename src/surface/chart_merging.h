// Putting charts together again: splitting what is not sound leaves crumbs, and every chart costs seams and gutter.
#pragma once

#include <vector>

#include "surface/flat_chart.h"

namespace redmap {

/// Joins charts, smallest first, with the neighbour they share most boundary with, wherever the two together are sound
/// (see is_sound()) and no larger than `largest_area`.
void merge_charts(const TriangleMesh& mesh, const FaceGraph& graph, double largest_area, double max_l2_stretch,
                  std::vector<FlatChart>& charts);

}  // namespace redmap
