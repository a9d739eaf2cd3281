// `redmap bake`: the reduction maps of a scene's objects.
#include "bake/bake.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "gpu/bake.h"
#include "map/map_file.h"
#include "map_json.h"
#include "render/closest_view.h"
#include "scene/map_shader.h"
#include "scene/scene_file.h"
#include "verify/search.h"

namespace redmap::cli {

namespace {

struct Options {
  std::string scene, folder, selection = "greedy", device;
  std::vector<std::string> objects, overrides;
  std::string size;                    ///< a number or "auto"; empty: as the scene says
  float texels_per_unit = 0;           ///< 0: as the scene says
  double max_error = 0, max_flip = 0;  ///< 0: not asked
  bool has_max_basis = false;
  BakeOptions bake;
  CommonOptions common;
};

/// Where a map goes: as the scene says, or that name in the folder asked for.
std::filesystem::path map_path(const Options& options, const Object& object) {
  return options.folder.empty() ? object.map_path : options.folder / object.map_path.filename();
}

/// The objects asked for; all of them if none was. Throws Error on a name that is not in the scene.
std::vector<Object> objects_to_bake(const Options& options, const SceneFile& file) {
  if (options.objects.empty()) return file.at(1).objects;
  std::vector<Object> objects;
  for (const std::string& name : options.objects)
    for (Object& object : file.objects(name)) objects.push_back(std::move(object));
  return objects;
}

/// What keeps two objects from sharing a map; empty if nothing does.
std::string_view difference(const Object& a, const Object& b) {
  if (a.surface->fingerprint() != b.surface->fingerprint()) return "surface";
  if (a.shader->info().text_hash != b.shader->info().text_hash) return "shader";
  if (a.shader->parameters() != b.shader->parameters()) return "shader parameters";
  if (a.map_size != b.map_size) return "map_size";
  return "";
}

/// The first object of every map, in the order of the scene, and those that share it.
struct PlannedMap {
  Object object;
  std::vector<std::string> sharing;
};

/// Throws Error on objects whose maps would overwrite each other.
std::vector<PlannedMap> plan_maps(const Options& options, const std::vector<Object>& objects) {
  std::vector<PlannedMap> planned;
  std::map<std::filesystem::path, std::size_t> index_of;
  for (const Object& object : objects) {
    const std::filesystem::path path = std::filesystem::absolute(map_path(options, object)).lexically_normal();
    const auto [found, is_new] = index_of.emplace(path, planned.size());
    if (is_new) {
      planned.push_back({object, {}});
      continue;
    }
    PlannedMap& first = planned[found->second];
    if (const std::string_view what = difference(first.object, object); !what.empty())
      throw Error(
          "bake: {}: expected one object, or several that are alike, found \"{}\" and \"{}\", which differ in {}",
          map_path(options, object).string(), first.object.name, object.name, what);
    if (object.name != first.object.name) first.sharing.push_back(object.name);
  }
  return planned;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw Error("{}: cannot make the folder for the maps: {}", folder.string(), error.message());
}

/// What --size and --texels-per-unit say in place of the scene; then settles what is left open, and says how.
nlohmann::json settle_sizes(const Options& options, SceneFile& file) {
  if (options.texels_per_unit > 0 && !options.size.empty() && options.size != "auto")
    throw Error("bake: --texels-per-unit: expected --size auto or no --size beside it, found --size {}", options.size);
  const bool is_auto = options.size == "auto" || options.texels_per_unit > 0;
  for (std::size_t i = 0; i < file.at(1).objects.size(); ++i) {
    if (is_auto) file.set_map_size(i, kAutoMapSize), file.set_texels_per_unit(i, options.texels_per_unit);
    if (!is_auto && !options.size.empty()) file.set_map_size(i, std::stoi(options.size));
  }
  nlohmann::json json = nlohmann::json::array();
  for (const SettledMapSize& settled : settle_map_sizes(file, [] { return interrupted(); })) {
    fmt::print(stderr, "{}: map size {}: {}\n", settled.object, settled.size, settled.reason);
    json.push_back({{"object", settled.object}, {"size", settled.size}, {"reason", settled.reason}});
  }
  stop_if_interrupted();
  return json;
}

/// Where to bake: texts of the user's own run on a device anyway, those of the library where one was asked for.
std::unique_ptr<TexelPasses> passes_for(const Options& options, const Object& object, const BakeOptions& bake_options) {
  const ShaderInfo& shader = object.shader->info();
  if (options.device.empty() && shader.file.empty()) return make_cpu_passes();
  const std::string reason = reason_to_bake_on_cpu(*object.shader, bake_options);
  if (reason.empty()) return make_device_passes(options.device);
  if (!options.device.empty()) fmt::print(stderr, "{}: baked on the CPU: {}\n", object.name, reason);
  return make_cpu_passes();
}

/// A map and what making it took.
struct BakedMap {
  ReductionMap map;
  BakeReport report;
  nlohmann::json searched = nullptr;
};

BakedMap bake_as_asked(const Options& options, const BakeOptions& bake_options, const Object& object) {
  BakedMap baked;
  const std::unique_ptr<TexelPasses> passes = passes_for(options, object, bake_options);
  baked.map = bake(*object.surface, *object.shader, bake_options, *passes, &baked.report);
  return baked;
}

/// The smallest map that keeps --max-error and --max-flip.
BakedMap bake_smallest(const Options& options, BakeOptions bake_options, const Object& object) {
  // Sizes up to this take seconds to bake; more has to be asked for.
  constexpr int kLargestSize = 4096;
  SearchOptions search;
  search.max_error = options.max_error, search.max_flip = options.max_flip, search.bake = std::move(bake_options);
  if (options.size.empty()) search.bake.size = kLargestSize;
  if (!options.has_max_basis) search.bake.max_basis = kMaxBasis;
  search.verify.pixels = 400;  // bounds of fewer vary so much that chance would choose the map
  search.verify.cancelled = interrupted;
  nlohmann::json steps = nlohmann::json::array();
  SearchResult result = search_smallest_map(object, search, [&](const SearchStep& step) {
    stop_if_interrupted();
    steps.push_back({{"size", step.size},
                     {"tolerance", step.tolerance},
                     {"basis", step.basis},
                     {"bytes_in_memory", step.bytes},
                     {"bound", step.bound},
                     {"flip_bound", step.flip_bound},
                     {"weakest", step.weakest}});
    if (options.common.verbose)
      fmt::print(stderr, "{}: {} texels, {} basis reflectances: error {:.4f}, FLIP {:.4f}, most of it from {}\n",
                 object.name, step.size, step.basis, step.bound, step.flip_bound, step.weakest);
  });
  if (!result.remark.empty()) fmt::print("{}: {}\n", object.name, result.remark);
  const auto asked = [](double limit) { return limit > 0 ? nlohmann::json(limit) : nlohmann::json(nullptr); };
  return {std::move(result.map),
          result.report,
          {{"max_error", asked(options.max_error)}, {"max_flip", asked(options.max_flip)}, {"steps", steps}}};
}

/// Directions that the bake had to add to the paper's.
void print_directions(const std::string& object, const BakeReport& report) {
  if (report.added_directions == 0) return;
  fmt::print("{}: the paper's 34 directions miss some of it (residual {:.3f} in others): {} more, {:.3f} left\n",
             object, report.disagreement_of_table, report.added_directions, report.disagreement);
}

/// What the bake found out about shading frames that the shader does not declare.
void print_hidden_frames(const std::string& object, const ReductionMap& map, const BakeReport& report) {
  if (!map.hides_frames) return;
  if (!map.tangents.empty())
    fmt::print("{}: {} hides the direction of its grain: found by probing\n", object, map.shader);
  if (report.probed_normals == 0) return;
  const double found = 1 - static_cast<double>(report.normals_not_found) / static_cast<double>(report.probed_normals);
  fmt::print("{}: {} hides its shading normals: found by probing at {:.2f} % of {} places{}\n", object, map.shader,
             100 * found, report.probed_normals, found < 1 ? ", the others keep the interpolated normal" : "");
}

BakedMap bake_with_progress(const Options& options, const Object& object) {
  BakeOptions bake_options = options.bake;
  bake_options.selection = options.selection == "paper" ? BasisSelection::kPaper : BasisSelection::kGreedy;
  bake_options.size = object.map_size;
  Progress progress("bake " + object.name);
  bake_options.progress = [&](float fraction, std::string_view) {
    progress.update(fraction);
    return !interrupted();
  };
  return options.max_error > 0 || options.max_flip > 0 ? bake_smallest(options, bake_options, object)
                                                       : bake_as_asked(options, bake_options, object);
}

nlohmann::json bake_object(const Options& options, const Object& object) {
  const std::filesystem::path path = map_path(options, object);
  auto [map, report, searched] = bake_with_progress(options, object);
  map.shader_origin = origin_of(object.shader->info(), path.parent_path());
  make_folder(path.parent_path());
  write_map(path, map);
  nlohmann::json json = bake_json(map, report);
  json["object"] = object.name;
  json["map"] = path.string();
  if (!searched.is_null()) json["search"] = searched;
  write_json(std::filesystem::path(path).replace_extension(".json"), json);

  fmt::print(
      "{}: {} on {}x{} texels: {} basis reflectance{}, residual {:.4f} of {:g}, {}{}{}, {:.2f} s, {:.1f} MB -> {}\n",
      object.name, map.shader, map.weights.extent(0).width, map.weights.extent(0).height, map.basis.size(),
      map.basis.size() == 1 ? "" : "s", map.residual, map.tolerance, verdict_name(map.verdict),
      map.verdict_reason.empty() ? "" : ": ", map.verdict_reason, report.seconds,
      static_cast<double>(texel_bytes(map)) * 1e-6, path.string());
  print_directions(object.name, report);
  print_hidden_frames(object.name, map, report);
  return json;
}

void bake_scene(const Options& options) {
  const ThreadLimit limit(static_cast<std::size_t>(options.common.threads));
  SceneFile file = SceneFile::load(options.scene, options.overrides, options.device);
  print_remarks(file, options.common);
  const nlohmann::json sizes = settle_sizes(options, file);
  nlohmann::json maps = nlohmann::json::array();
  for (const PlannedMap& planned : plan_maps(options, objects_to_bake(options, file))) {
    maps.push_back(bake_object(options, planned.object));
    for (const std::string& name : planned.sharing)
      fmt::print("{}: shares {}\n", name, map_path(options, planned.object).string());
    stop_if_interrupted();
  }
  write_json(options.common.json, {{"maps", maps}, {"settled_sizes", sizes}});
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("bake", "Make the reduction maps of a scene");
  sub->footer(
      "Examples:\n"
      "  redmap bake scene.toml                        every object's map, where the scene says\n"
      "  redmap bake scene.toml --object bunny --size 2048 -o maps\n"
      "  redmap bake scene.toml --max-error 0.05       the smallest maps that keep it, with their certificates");
  auto options = std::make_shared<Options>();
  BakeOptions& bake_options = options->bake;
  sub->add_option("scene", options->scene, "the scene's TOML file")->required();
  sub->add_option("--object", options->objects, "only this object (may be given several times)")
      ->allow_extra_args(false);
  sub->add_option("--size", options->size,
                  "texels across a map, or auto: as fine as the pixels of the closest view over all "
                  "frames; default: as the scene says")
      ->check(CLI::Range(1, 16384) | CLI::IsMember({"auto"}));
  sub->add_option("--texels-per-unit", options->texels_per_unit,
                  "with --size auto: this many texels along a unit of length of the object instead")
      ->check(CLI::PositiveNumber);
  sub->add_option("--tolerance", bake_options.tolerance, "largest residual, in units of a sample's RMS")
      ->capture_default_str();
  const CLI::Option* max_basis =
      sub->add_option("--max-basis", bake_options.max_basis, "most basis reflectances")->capture_default_str();
  sub->add_option("--sub-samples", bake_options.sub_samples, "n x n points a texel where neighbours differ")
      ->capture_default_str();
  sub->add_option(
         "--max-error", options->max_error,
         "the smallest map whose error 95 % of the pixels keep at this (redmap verify); --size and --max-basis "
         "are then the most that is tried")
      ->check(CLI::PositiveNumber);
  sub->add_option("--max-flip", options->max_flip, "the same in units of FLIP; with --max-error both are kept")
      ->check(CLI::PositiveNumber);
  sub->add_option("--selection", options->selection, "who chooses the basis: greedy, or the paper's blocks")
      ->check(CLI::IsMember({"greedy", "paper"}))
      ->capture_default_str();
  add_override_option(*sub, options->overrides);
  add_device_option(*sub, options->device);
  sub->add_option("-o,--output", options->folder, "folder for the maps");
  add_common_options(*sub, options->common);
  sub->callback([options, max_basis] {
    options->has_max_basis = max_basis->count() > 0;
    bake_scene(*options);
  });
}

}  // namespace redmap::cli
