// Reflectances of a grid of places on a surface, as the analysis sees them: what its ablations are measured on.
#pragma once

#include <vector>

#include "analysis/basis.h"
#include "analysis/directions.h"
#include "laboratory.h"

namespace redmap::bench {

/// Rows scaled to unit RMS, place by place.
struct ReflectanceGrid {
  int side = 0;                      ///< texels across the grid that the places lie in
  std::vector<std::uint32_t> texel;  ///< of each place, row-major
  std::vector<float> values, scales;
  int rows = 0;

  std::size_t places() const { return texel.size(); }
  const float* operator[](std::size_t place) const { return &values[place * rows]; }
  ReflectanceVectors vectors() const { return {values, rows}; }
};

/// Samples `shader` at the centres of side x side texels, in `directions`.
ReflectanceGrid sample_grid(const Surface& surface, const Shader& shader, int side, const DirectionPairs& directions);

/// Pairs `first` and `second` together.
DirectionPairs joined(const DirectionPairs& first, const DirectionPairs& second);
/// `count` pairs, evenly taken from `all`.
DirectionPairs some_of(const DirectionPairs& all, int count);

/// A basis of some of the places.
ReflectanceBasis basis_of(const ReflectanceGrid& grid, const std::vector<std::size_t>& chosen);

/// Root mean square and largest residual of all places.
struct FitErrors {
  double rms = 0, largest = 0;
};
FitErrors fit_all(const ReflectanceGrid& grid, const ReflectanceBasis& basis);

/// The tables of measure_analysis().
Table measure_directions(Laboratory& laboratory);
Table measure_pca(Laboratory& laboratory);
Table measure_pca_colours(Laboratory& laboratory);
Table measure_blocks(Laboratory& laboratory);
Table measure_bits(Laboratory& laboratory);

}  // namespace redmap::bench
