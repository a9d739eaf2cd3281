// Where to cut: charts that are flat and compact (variational shape approximation, Cohen-Steiner et al. 2004).
#pragma once

#include <vector>

#include "surface/face_graph.h"

namespace redmap {

/// A label for every face. About `count` charts, one more for every part that no seed reaches. `compactness` weighs the
/// distance to a chart's centre against the deviation from its mean normal.
std::vector<int> grow_charts(const FaceGraph& graph, int count, double compactness, int rounds);

}  // namespace redmap
