// Which texels of a finer level lie under those of a coarser one.
#pragma once

#include <algorithm>
#include <vector>

namespace redmap {

/// Along one axis: the first finer texel, and how much of the coarser each makes up (parts sum to 1).
struct Overlap {
  int first = 0;
  std::vector<float> part;
};

inline std::vector<Overlap> overlaps(int fine, int coarse) {
  std::vector<Overlap> result(coarse);
  const double step = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    const double begin = i * step, end = i + 1 == coarse ? fine : (i + 1) * step;
    result[i].first = static_cast<int>(begin);
    for (int j = result[i].first; j < end; ++j)
      result[i].part.push_back(static_cast<float>((std::min<double>(end, j + 1) - std::max<double>(begin, j)) / step));
  }
  return result;
}

}  // namespace redmap
