// A mesh file on the command line: how it is named and oriented, and what is said about it when it was read.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "surface/mesh.h"

namespace redmap::cli {

struct MeshInput {
  std::string path, up, unit, part;
};

/// Declares the file, --up, --unit and --part on `sub`, bound to `input`, which must outlive the parse.
void add_mesh_input(CLI::App& sub, MeshInput& input);

/// Reads it, prints what was dropped, what its file leaves unsaid, its parts and whether its uv can be used, and says
/// the same in `json`. Throws Error.
TriangleMesh read_mesh_input(const MeshInput& input, nlohmann::json& json);

}  // namespace redmap::cli
