// Which way is up in a mesh file, and how long its unit is: asked for, read where the format says so, and never guessed
// in silence. redmap's own objects have y up; with a unit they are in metres.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh.h"

namespace redmap {

enum class UpAxis { kY, kZ };

/// What somebody said about a file. Nothing said: y, and numbers as they are.
struct MeshUnits {
  std::optional<UpAxis> up;
  std::optional<std::string> unit;  ///< one of unit_names()
  friend bool operator==(const MeshUnits&, const MeshUnits&) = default;
};

/// "m", "cm", "mm", "km", "in", "ft".
std::vector<std::string> unit_names();
/// Metres in a unit. Throws Error on a name that is not among unit_names().
float metres_per(std::string_view unit);

/// Turns z up to y up, (x, y, z) to (x, z, -y), and scales a unit that was said to metres. Normals turn along.
void apply_units(TriangleMesh& mesh, const MeshUnits& units);

/// What is being taken for granted, as "bunny.obj says neither up-axis nor unit: y up, numbers as they are". glTF says
/// both: y and metres.
std::string describe_units(const std::filesystem::path& path, const MeshUnits& units);

}  // namespace redmap
