// `redmap export`: a reduction map for renderers that are not ours.
#include "export/export.h"

#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "map/map_file.h"
#include "scene/map_shader.h"
#include "scene/scene_file.h"

namespace redmap::cli {

namespace {

struct Options {
  std::string map, kind, output, scene, device, materials = "one";
  bool gzip = false;
  CommonOptions common;
};

/// The object of the scene that the map belongs to: the one that it was baked for.
Object object_of(const Options& options, const std::shared_ptr<const ReductionMap>& map) {
  const SceneFile file = SceneFile::load(options.scene, {}, options.device);
  print_remarks(file, options.common);
  for (const Object& object : file.at(1).objects)
    if (object.surface->fingerprint() == map->surface_fingerprint && object.shader->info().name == map->shader) {
      require_map_of(object, *map);
      return object;
    }
  throw Error("{}: expected an object whose map is {}, of shader '{}', found none on the same surface", options.scene,
              options.map, map->shader);
}

ExportInput input_of(const Options& options) {
  ExportInput input;
  input.name = std::filesystem::path(options.map).stem().string();
  input.map = std::make_shared<const ReductionMap>(read_map(options.map));
  if (options.scene.empty()) {
    input.shader = shader_of(*input.map, options.map, options.device);
  } else {
    const Object object = object_of(options, input.map);
    input.shader = object.shader, input.surface = object.surface;
  }
  return input;
}

/// How well the materials stand in for the basis; fits that are poor are named.
void print_fits(const ExportInput& input) {
  for (std::size_t b = 0; b < input.fits.size(); ++b) {
    const MaterialFit& fit = input.fits[b];
    fmt::print(
        "basis {:<2} fit error {:.4f}{}\n", b, fit.error,
        fit.is_poor() ? fmt::format(": no material of glTF is like this part of shader '{}'", input.map->shader) : "");
  }
}

void run(const Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  ExportInput input = input_of(options);
  if (input.map->verdict == MapVerdict::kDoesNotReduce)
    fmt::print(stderr, "{}: the map does not stand in for its shader: {}\n", options.map, input.map->verdict_reason);
  ExportFolder folder(options.output);
  if (options.kind != "glsl") {
    input.fits = fit_basis(*input.map, *input.shader);
    print_fits(input);
  }
  stop_if_interrupted();
  if (options.kind == "gltf")
    export_gltf(input, options.materials == "k" ? MaterialCount::kOneABasis : MaterialCount::kOne, folder);
  if (options.kind == "ktx2") export_ktx2(input, folder);
  if (options.kind == "tx") export_tx(input, folder);
  if (options.kind == "mtlx") export_mtlx(input, folder);
  if (options.kind == "glsl") export_glsl(input, options.gzip ? Compression::kGzip : Compression::kNone, folder);
  stop_if_interrupted();
  folder.commit();
  fmt::print("{}\n", options.output);
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("export", "Write a reduction map as textures and materials for other renderers");
  sub->footer(
      "Examples:\n"
      "  redmap export maps/bunny.exr --scene bunny.toml --to gltf -o bunny    one averaged material, opens anywhere\n"
      "  redmap export maps/bunny.exr --scene bunny.toml --to gltf --materials k -o bunny\n"
      "  redmap export maps/bunny.exr --to ktx2 -o textures");
  auto options = std::make_shared<Options>();
  sub->add_option("map", options->map, "the map's file")->required();
  sub->add_option("--to", options->kind, "what to write")
      ->required()
      ->check(CLI::IsMember({"gltf", "ktx2", "tx", "mtlx", "glsl"}));
  sub->add_option("-o,--output", options->output, "folder to write; an earlier export there is replaced")->required();
  sub->add_option("--scene", options->scene, "the scene that the map was baked from, for its mesh");
  sub->add_option("--materials", options->materials, "gltf: one averaged material, or k of them with masks")
      ->check(CLI::IsMember({"one", "k"}))
      ->capture_default_str();
  sub->add_flag("--gzip", options->gzip, "glsl: compressed files too, for pages");
  add_device_option(*sub, options->device);
  add_common_options(*sub, options->common);
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
