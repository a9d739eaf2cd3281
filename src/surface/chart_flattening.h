// Laying one chart out in the plane: as conformal as can be, then as isometric as can be.
#pragma once

#include "surface/flat_chart.h"

namespace redmap {

/// Fills `plane` with the least squares conformal map (Levy et al. 2002), not scaled. False if there is none: no
/// boundary, or a system that is singular.
bool solve_conformal(FlatChart& chart);

/// Makes `plane` more isometric, as rigid as possible (Liu et al. 2008). `plane` must have true lengths on average.
/// Leaves it alone where that would turn a triangle over.
void relax_isometric(FlatChart& chart);

}  // namespace redmap
