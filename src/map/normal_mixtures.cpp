#include "map/normal_mixtures.h"

#include <algorithm>

namespace redmap {

NormalMixtures NormalMixtures::one_each(std::size_t hits, std::vector<LaneVector<float>> basis_weights) {
  NormalMixtures mixtures;
  mixtures.first.resize(hits + 1);
  for (std::size_t i = 0; i <= hits; ++i) mixtures.first[i] = static_cast<std::uint32_t>(i);
  for (LaneVector<float>* values : {&mixtures.x, &mixtures.y, &mixtures.xx, &mixtures.xy, &mixtures.yy})
    values->assign(padded(hits), 0.0f);
  mixtures.weights = std::move(basis_weights);
  mixtures.one_a_hit = true;
  return mixtures;
}

NormalMixtures NormalMixtures::none(std::size_t basis) {
  NormalMixtures mixtures;
  mixtures.first.push_back(0);
  mixtures.weights.resize(basis);
  return mixtures;
}

void NormalMixtures::make_room(std::size_t count) {
  if (count <= x.size()) return;
  const std::size_t size = std::max(count, 2 * x.size());
  for (LaneVector<float>* values : {&x, &y, &xx, &xy, &yy}) values->resize(size);
  for (LaneVector<float>& values : weights) values.resize(size);
}

}  // namespace redmap
