// The part of a map's file that holds its distributions of normals, docs/map_format.md.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>

#include <string>

#include "map/normal_pyramid.h"

namespace redmap {

inline constexpr const char* kNormalsPart = "normals";

/// `weights`: of the same map.
Imf::Header make_normals_header(const WeightPyramid& weights);
void write_normals(Imf::MultiPartOutputFile& file, int part, const NormalPyramid& normals);

/// Throws Error, beginning with `where`, unless the part is what write_normals() writes for a map of `weights`.
NormalPyramid read_normals(Imf::MultiPartInputFile& file, int part, const WeightPyramid& weights,
                           const std::string& where);

}  // namespace redmap
