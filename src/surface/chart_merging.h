// Putting small charts back: splitting what is not sound leaves crumbs, and every chart costs seams and gutter.
#pragma once

#include <vector>

#include "surface/flat_chart.h"

namespace redmap {

/// Joins every chart smaller than `small_area` with the neighbour it shares most boundary with, wherever the two
/// together are sound (see is_sound()) and no larger than `largest_area`.
void merge_small_charts(const TriangleMesh& mesh, const FaceGraph& graph, double small_area, double largest_area,
                        double max_l2_stretch, std::vector<FlatChart>& charts);

}  // namespace redmap
