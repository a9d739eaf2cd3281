// `redmap unwrap`: gives a mesh an atlas, for use here or elsewhere, and shows how good it is (paper, Fig. 2).
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "atlas_input.h"
#include "base/image.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "mesh_input.h"
#include "surface/atlas_picture.h"
#include "surface/uv_quality.h"

namespace redmap::cli {

namespace {

constexpr int kPictureSize = 1024;

struct Options {
  MeshInput in;
  std::string out, picture;
  AtlasInput atlas;
  CommonOptions common;
};

/// Measured on the uv themselves, overlap at twice the `size` that the atlas is made for.
void report_quality(const TriangleMesh& mesh, const AtlasReport& atlas, int size, double seconds,
                    nlohmann::json& json) {
  const UvReport uv = judge_uv(mesh, 2 * size);
  const auto row = [](const char* name, const std::string& value) { fmt::print("  {:<28}{:>10}\n", name, value); };
  row("triangles", fmt::format("{}", mesh.triangles.size()));
  row("charts", fmt::format("{}", atlas.charts));
  row("L2 stretch", fmt::format("{:.3f}", atlas.l2_stretch));
  row("texel density, 5 % / 95 %", fmt::format("{:.2f} / {:.2f}", uv.density_low, uv.density_high));
  row("of the square covered", fmt::format("{:.1f} %", 100 * atlas.packing));
  row("flipped triangles", fmt::format("{}", atlas.flips));
  row(fmt::format("overlap at {} texels", 2 * size).c_str(), fmt::format("{}", uv.overlapping_texels));
  row("seconds", fmt::format("{:.2f}", seconds));
  json["atlas"] = {{"charts", atlas.charts},
                   {"l2_stretch", atlas.l2_stretch},
                   {"density_q05", uv.density_low},
                   {"density_q95", uv.density_high},
                   {"packing", atlas.packing},
                   {"flips", atlas.flips},
                   {"overlap_texels", uv.overlapping_texels},
                   {"seconds", seconds}};
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  nlohmann::json json;
  TriangleMesh mesh = read_mesh_input(options.in, json);
  const auto start = std::chrono::steady_clock::now();
  const AtlasReport atlas = unwrap_as_asked(mesh, options.atlas, json);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  stop_if_interrupted();
  report_quality(mesh, atlas, options.atlas.atlas.resolution, seconds, json);
  write_mesh(options.out, mesh);
  if (!options.picture.empty()) write_image(draw_atlas(mesh, kPictureSize), options.picture);
  json["vertices"] = mesh.positions.size();
  json["triangles"] = mesh.triangles.size();
  write_json(options.common.json, json);
}

}  // namespace

void add_unwrap_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("unwrap", "Give a mesh an atlas, and show how good it is");
  sub->footer(
      "Examples:\n"
      "  redmap unwrap bunny.ply -o bunny.obj --picture bunny_atlas.png\n"
      "  redmap unwrap car.glb --part tyres -o tyres.obj --size 2048");
  auto options = std::make_shared<Options>();
  add_mesh_input(*sub, options->in);
  sub->add_option("-o,--output", options->out, "the mesh to write, with its uv: .obj or .ply")->required();
  sub->add_option("--picture", options->picture, "draw the atlas: .png or .exr")->type_name("FILE");
  add_atlas_input(*sub, options->atlas);
  add_common_options(*sub, options->common);
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
