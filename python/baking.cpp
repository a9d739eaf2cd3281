// Baking: a surface and a shader become a reduction map.
#include "bake/bake.h"

#include "bake/passes.h"
#include "gpu/bake.h"
#include "interruptible.h"
#include "map_origin.h"
#include "scene/map_shader.h"

namespace redmap::python {
namespace {

BasisSelection selection_of(const std::string& name) {
  if (name == "greedy") return BasisSelection::kGreedy;
  if (name == "paper") return BasisSelection::kPaper;
  throw Error("selection: expected \"greedy\" or \"paper\", found \"{}\"", name);
}

/// Texts run on a device, everything else on the CPU, unless a device was asked for.
std::unique_ptr<TexelPasses> passes_for(const Shader& shader, const BakeOptions& options, const std::string& device) {
  const bool wants_device = !device.empty() || !shader.info().file.empty();
  if (wants_device && reason_to_bake_on_cpu(shader, options).empty()) return make_device_passes(device);
  return make_cpu_passes();
}

std::shared_ptr<const ReductionMap> bake_map(const Surface& surface, const Shader& shader, int size, float tolerance,
                                             int max_basis, int sub_samples, const std::string& selection,
                                             const std::string& device, BakeReport* report, const Progress& progress) {
  auto map = std::make_shared<ReductionMap>();
  BakeOptions options{size, tolerance, max_basis, sub_samples, selection_of(selection), {}};
  run_interruptibly(
      [&](Work& work) {
        options.progress = [&](float part, std::string_view) {
          work.tell(part);
          return !work.stopped();
        };
        *map = bake(surface, shader, options, *passes_for(shader, options, device), report);
      },
      progress);
  map->shader_origin = origin_of(shader.info(), {});
  make_origin_absolute(map->shader_origin, {});
  return map;
}

/// The comment on every option, for the function that takes them.
std::string bake_doc() {
  return fmt::format(
      "{}\n\nsize: {}\ntolerance: {}\nmax_basis: {}\nsub_samples: {}\nselection: greedy, or the paper's blocks\n"
      "device: where to bake; texts of your own run on one anyway\nreport: filled in\nprogress: told the part done",
      doc::bake, doc::BakeOptions_size, doc::BakeOptions_tolerance, doc::BakeOptions_max_basis,
      doc::BakeOptions_sub_samples);
}

void bind_report(nb::module_& module) {
  nb::class_<BakeReport> report(module, "BakeReport", doc::BakeReport);
  nb::class_<BakeReport::Stage>(report, "Stage")
      .def_ro("name", &BakeReport::Stage::name)
      .def_ro("seconds", &BakeReport::Stage::seconds);
  report.def(nb::init<>())
      .def_ro("stages", &BakeReport::stages)
      .def_ro("seconds", &BakeReport::seconds)
      .def_ro("peak_bytes", &BakeReport::peak_bytes, doc::BakeReport_peak_bytes)
      .def_ro("covered_texels", &BakeReport::covered_texels)
      .def_ro("refined_texels", &BakeReport::refined_texels, doc::BakeReport_refined_texels)
      .def_ro("distinct_reflectances", &BakeReport::distinct_reflectances, doc::BakeReport_distinct_reflectances)
      .def_ro("added_directions", &BakeReport::added_directions, doc::BakeReport_added_directions)
      .def_ro("probed_normals", &BakeReport::probed_normals, doc::BakeReport_probed_normals)
      .def_ro("normals_not_found", &BakeReport::normals_not_found, doc::BakeReport_normals_not_found);
}

}  // namespace

void bind_baking(nb::module_& module) {
  bind_report(module);
  const BakeOptions options;
  module.def("bake", &bake_map, "surface"_a, "shader"_a, nb::kw_only(), "size"_a = options.size,
             "tolerance"_a = options.tolerance, "max_basis"_a = options.max_basis,
             "sub_samples"_a = options.sub_samples, "selection"_a = "greedy", "device"_a = "", "report"_a = nb::none(),
             "progress"_a = nb::none(), bake_doc().c_str());
}

}  // namespace redmap::python
