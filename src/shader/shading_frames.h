// Shading frames that are not those of the surface: turned about the normal by what a shader says of its grain, or
// another frame altogether for a shader that hides its own.
#pragma once

#include <memory>
#include <vector>

#include "shader/shader.h"

namespace redmap {

/// Cosine and sine of the angle, about `normal`, from `place_tangent` to `shading_tangent`, all unit vectors of one
/// space. (1, 0) where there is none: a tangent that is the normal.
Vec2 tangent_turn(Vec3 normal, Vec3 place_tangent, Vec3 shading_tangent);

/// `patterns` asked in other frames: pattern i under directions in frames[i], which is given in the frame that
/// `patterns` are asked in. `normals` and `tangents` are what shading_normals() and shading_tangents() are to answer,
/// in object space; empty: nothing.
std::unique_ptr<BoundPatterns> in_frames(std::unique_ptr<BoundPatterns> patterns, std::vector<Frame> frames,
                                         Planes<3> normals = {}, Planes<3> tangents = {});

/// `shader` bound to `points`, asked in `frames`; in its own where these are empty.
std::unique_ptr<BoundPatterns> bind_in_frames(const Shader& shader, const SurfacePoints& points,
                                              std::vector<Frame> frames);

}  // namespace redmap
