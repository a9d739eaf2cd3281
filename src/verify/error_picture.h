// Where on its surface a map is wrong: errors painted over its atlas.
#pragma once

#include <span>

#include "base/image.h"
#include "map/reduction_map.h"
#include "verify/measured_pixel.h"

namespace redmap {

/// The atlas, v upwards, up to `width` pixels across: where pixels were measured their largest error, between them what
/// is near; from dark (none) over red to white (`white`, above 0, and more). A ring is around the worst. Grey is no
/// surface.
Image paint_errors(const ReductionMap& map, std::span<const MeasuredPixel> pixels, double white, int width = 512);

}  // namespace redmap
