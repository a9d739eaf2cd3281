#include "surface/mesh_units.h"

#include <fmt/format.h>

#include <array>

#include "base/error.h"
#include "base/nearest.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

struct Unit {
  const char* name;
  float metres;
};

// Inch and foot by the international agreement of 1959.
constexpr std::array<Unit, 6> kUnits = {
    {{"m", 1}, {"cm", 0.01f}, {"mm", 0.001f}, {"km", 1000}, {"in", 0.0254f}, {"ft", 0.3048f}}};

}  // namespace

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const Unit& unit : kUnits) names.emplace_back(unit.name);
  return names;
}

float metres_per(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (name == unit.name) return unit.metres;
  throw Error("expected a unit, one of m, cm, mm, km, in and ft, found \"{}\" (did you mean \"{}\"?)", name,
              nearest(name, unit_names()));
}

void apply_units(TriangleMesh& mesh, const MeshUnits& units) {
  const float scale = units.unit ? metres_per(*units.unit) : 1;
  if (scale != 1)
    for (Vec3& p : mesh.positions) p = p * scale;
  if (units.up != UpAxis::kZ) return;
  for (std::vector<Vec3>* vectors : {&mesh.positions, &mesh.normals})
    for (Vec3& v : *vectors) v = {v.x, v.z, -v.y};
}

std::string describe_units(const std::filesystem::path& path, const MeshUnits& units) {
  const std::string extension = lower_extension(path), name = path.filename().string();
  const bool is_gltf = extension == ".gltf" || extension == ".glb";
  const char* up = units.up == UpAxis::kZ ? "z up, turned to y up" : "y up";
  const std::string unit = units.unit ? fmt::format("in {}, scaled to metres", *units.unit)
                           : is_gltf  ? std::string("in metres")
                                      : std::string("numbers as they are");
  if (units.up && units.unit) return fmt::format("{}: {}, {}, as asked for", name, up, unit);
  if (is_gltf) return fmt::format("{}: {}, {} (glTF says y and metres)", name, up, unit);
  const char* unsaid = units.up ? "no unit" : units.unit ? "no up-axis" : "neither up-axis nor unit";
  return fmt::format("{} says {}: {}, {}", name, unsaid, up, unit);
}

}  // namespace redmap
