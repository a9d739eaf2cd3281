// The part of a map's file that holds the leaves of its surface clusters, docs/map_format.md.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>

#include <string>

#include "map/surface_clusters.h"

namespace redmap {

/// All parts of a file share the window they are shown in: that of the map, `extent`.
Imf::Header make_clusters_header(const SurfaceClusters& clusters, Extent extent);
void write_clusters(Imf::MultiPartOutputFile& file, int part, const SurfaceClusters& clusters);

/// Throws Error, beginning with `where`, unless the part is what write_clusters() writes for `channels` weights.
SurfaceClusters read_clusters(Imf::MultiPartInputFile& file, int part, int channels, const std::string& where);

}  // namespace redmap
