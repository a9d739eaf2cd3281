#include "atlas_input.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "surface/map_size.h"

namespace redmap::cli {

namespace {

std::map<std::string, float> parse_part_densities(const std::vector<std::string>& arguments) {
  std::map<std::string, float> densities;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.rfind('=');
    float density = 0;
    if (equals == 0 || equals == std::string::npos || !CLI::detail::lexical_cast(argument.substr(equals + 1), density))
      throw Error("--part-density: expected NAME=DENSITY, such as ears=2, found \"{}\"", argument);
    densities[argument.substr(0, equals)] = density;
  }
  return densities;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  return area;
}

/// As many texels as the density asks for, once it is known how much of the square is covered.
AtlasReport unwrap_for_density(TriangleMesh& mesh, AtlasInput& input, nlohmann::json& json) {
  if (!(input.texels_per_unit > 0))
    throw Error("--size auto: expected --texels-per-unit beside it, since a mesh alone has no view; found none");
  // Atlases cover about two thirds; fewer triangles or many charts less, and then it is done again.
  constexpr double kUsualPacking = 0.66;
  const double area = area_of(mesh);
  input.atlas.resolution = map_size_for_density(area, kUsualPacking, input.texels_per_unit);
  AtlasReport report = unwrap(mesh, input.atlas);
  while (map_size_for_density(area, report.packing, input.texels_per_unit) > input.atlas.resolution) {
    input.atlas.resolution *= 2;
    report = unwrap(mesh, input.atlas);
  }
  const double density = input.atlas.resolution * std::sqrt(report.packing / area);
  fmt::print(stderr, "map size {}: {:g} texels a unit of length, {:g} asked for\n", input.atlas.resolution, density,
             input.texels_per_unit);
  json["texels_per_unit"] = density;
  return report;
}

}  // namespace

void add_atlas_input(CLI::App& sub, AtlasInput& input) {
  sub.add_option("--size", input.size, "texels across the map that the atlas is for, or auto: see --texels-per-unit")
      ->check(CLI::Range(4, kLargestMapSize) | CLI::IsMember({"auto"}))
      ->capture_default_str();
  sub.add_option("--texels-per-unit", input.texels_per_unit,
                 "with --size auto: the power of two at which so many texels lie along a unit of length")
      ->check(CLI::PositiveNumber);
  sub.add_option("--charts", input.atlas.charts, "charts to start from")->capture_default_str();
  sub.add_option("--max-stretch", input.atlas.max_l2_stretch, "split charts of more L2 stretch than this")
      ->capture_default_str();
  sub.add_option("--part-density", input.part_densities,
                 "texels along a length on a group or material, relative to the rest, for example ears=2; repeatable")
      ->type_name("NAME=DENSITY")
      ->allow_extra_args(false);
}

AtlasReport unwrap_as_asked(TriangleMesh& mesh, AtlasInput& input, nlohmann::json& json) {
  input.atlas.part_density = parse_part_densities(input.part_densities);
  AtlasReport report;
  if (input.size == "auto") {
    report = unwrap_for_density(mesh, input, json);
  } else {
    if (input.texels_per_unit > 0)
      throw Error("--texels-per-unit: expected --size auto beside it, found --size {}", input.size);
    input.atlas.resolution = std::stoi(input.size);
    report = unwrap(mesh, input.atlas);
  }
  json["size"] = input.atlas.resolution;
  return report;
}

}  // namespace redmap::cli
