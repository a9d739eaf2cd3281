#include "reflectance_grid.h"

#include <algorithm>
#include <cmath>

#include "analysis/sampling.h"

namespace redmap::bench {

namespace {

/// Padding repeats the last pair, since shaders evaluate it too.
DirectionPairs pick(const DirectionPairs& all, const std::vector<std::size_t>& chosen) {
  DirectionPairs pairs;
  pairs.resize(chosen.size());
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    const std::size_t from = chosen[std::min(i, chosen.size() - 1)];
    pairs.to_light.set(i, all.to_light.get(from)), pairs.to_viewer.set(i, all.to_viewer.get(from));
  }
  return pairs;
}

}  // namespace

ReflectanceGrid sample_grid(const Surface& surface, const Shader& shader, int side, const DirectionPairs& directions) {
  const Extent extent{side, side};
  const Vec2 centre[] = {{0.5f, 0.5f}};
  TexelPoints found;
  surface.rasterize(extent, {0, 0, side, side}, centre, {}, found);
  // Shaders evaluate the padding too.
  for (std::size_t i = found.points.size(); i < found.points.position.stride(); ++i) {
    const std::size_t last = found.points.size() - 1;
    found.points.position.set(i, found.points.position.get(last));
    found.points.normal.set(i, found.points.normal.get(last));
    found.points.tangent.set(i, found.points.tangent.get(last));
  }
  SampledReflectances sampled;
  ReflectanceSampler(shader.info(), directions).sample(*shader.bind(found.points), sampled);
  RowScaling scaling;
  scaling.add(sampled);
  ReflectanceGrid grid;
  grid.side = side, grid.texel = found.texel, grid.rows = sampled.rows, grid.scales = scaling.scales();
  grid.values.resize(grid.places() * static_cast<std::size_t>(grid.rows));
  for (std::size_t i = 0; i < grid.places(); ++i)
    scaled_reflectance(sampled, i, grid.scales, &grid.values[i * grid.rows]);
  return grid;
}

DirectionPairs joined(const DirectionPairs& first, const DirectionPairs& second) {
  DirectionPairs pairs;
  const std::size_t size = first.to_light.size() + second.to_light.size();
  pairs.resize(size);
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    const std::size_t j = std::min(i, size - 1);
    const bool is_first = j < first.to_light.size();
    const DirectionPairs& from = is_first ? first : second;
    const std::size_t k = is_first ? j : j - first.to_light.size();
    pairs.to_light.set(i, from.to_light.get(k)), pairs.to_viewer.set(i, from.to_viewer.get(k));
  }
  return pairs;
}

DirectionPairs some_of(const DirectionPairs& all, int count) {
  std::vector<std::size_t> chosen;
  for (int i = 0; i < count; ++i) chosen.push_back(static_cast<std::size_t>(i) * all.to_light.size() / count);
  return pick(all, chosen);
}

ReflectanceBasis basis_of(const ReflectanceGrid& grid, const std::vector<std::size_t>& chosen) {
  ReflectanceBasis basis(grid.rows);
  for (const std::size_t place : chosen) basis.add(grid[place]);
  return basis;
}

FitErrors fit_all(const ReflectanceGrid& grid, const ReflectanceBasis& basis) {
  FitErrors errors;
  BasisWeights weights;
  for (std::size_t i = 0; i < grid.places(); ++i) {
    const double residual = basis.fit(grid[i], weights);
    errors.rms += residual * residual, errors.largest = std::max(errors.largest, residual);
  }
  errors.rms = std::sqrt(errors.rms / static_cast<double>(grid.places()));
  return errors;
}

}  // namespace redmap::bench
