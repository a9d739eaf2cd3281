// How an atlas is asked for on the command line: the options that `redmap mesh` and `redmap unwrap` share.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "surface/atlas.h"

namespace redmap::cli {

struct AtlasInput {
  AtlasOptions atlas;
  std::string size = "1024";                ///< a number or "auto"
  float texels_per_unit = 0;                ///< for "auto"
  std::vector<std::string> part_densities;  ///< "NAME=DENSITY"
};

/// Declares --size, --texels-per-unit, --charts, --max-stretch and --part-density on `sub`, bound to `input`, which
/// must outlive the parse.
void add_atlas_input(CLI::App& sub, AtlasInput& input);

/// Unwraps `mesh` as asked for. Leaves the size that was used in `input.atlas.resolution`; says it on stderr where it
/// was chosen, and in `json`. Throws Error.
AtlasReport unwrap_as_asked(TriangleMesh& mesh, AtlasInput& input, nlohmann::json& json);

}  // namespace redmap::cli
