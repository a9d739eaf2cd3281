#include "export_bench.h"

#include "bake/bake.h"
#include "exported_shading.h"
#include "map/map_file.h"
#include "quality/bench_scene.h"
#include "quality/error_sums.h"
#include "quality/reference.h"

namespace redmap::bench {

namespace {

ObjectData bake_data(const Surface& surface, const Shader& shader, const ExportBenchOptions& options) {
  BakeOptions bake_options;
  bake_options.size = options.map_size;
  bake_options.progress = [&](float, std::string_view) { return !(options.cancelled && options.cancelled()); };
  ObjectData data;
  data.map = std::make_shared<const ReductionMap>(bake(surface, shader, bake_options));
  return data;
}

using StandIn = std::function<std::unique_ptr<ObjectShading>(const Object&)>;

/// All that is exported of a map, to be rendered.
struct Exported {
  std::vector<MaterialFit> fits;
  StandIn materials, one;
};
Exported export_all(const ObjectData& data, const Shader& shader) {
  Exported all{fit_basis(*data.map, shader), {}, {}};
  const auto masks = std::make_shared<const Masks>(mask_textures(*data.map));
  const auto normals = std::make_shared<const std::optional<NormalTextures>>(normal_textures(*data.map));
  const auto one = std::make_shared<const OneMaterial>(average_material(*data.map, all.fits));
  const auto grain = std::make_shared<const std::optional<Texture>>(grain_texture(*data.map));
  all.materials = [masks, normals, grain, fits = all.fits](const Object& object) {
    return make_masked_shading(object.shader, *masks, fits, *normals, *grain);
  };
  all.one = [one](const Object& object) { return make_one_material_shading(object.shader, *one); };
  return all;
}

struct View {
  Scene scene;
  Image reference;
  std::vector<PixelClass> classes;
};

double error_of(const std::vector<View>& views, const ObjectData& data, Method method, const StandIn& stand_in = {}) {
  RenderOptions options;
  options.method = method, options.stand_in = stand_in;
  options.spp = method == Method::kSupersample ? 64 : 0;
  ErrorSums sums;
  for (std::size_t i = 0; i < views.size(); ++i) {
    Renderer renderer(views[i].scene, options, {data});
    sums.add(renderer.render(views[i].scene, static_cast<int>(i)).image, views[i].reference, views[i].classes);
  }
  return sums.interior();
}

ExportBenchRow measure(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                       const ObjectData& data, const Exported& exported, double minification,
                       const ExportBenchOptions& options) {
  std::vector<View> views;
  ErrorSums between_halves;
  for (int i = 0; i < options.views; ++i) {
    View view{make_bench_scene(surface, shader, options.map_size, minification, i), {}, {}};
    view.reference = render_reference(view.scene, {data}, options.reference_spp, i, view.classes, between_halves);
    views.push_back(std::move(view));
  }
  ExportBenchRow row;
  row.shader = shader->info().name, row.minification = minification;
  row.verdict = verdict_name(data.map->verdict), row.basis = static_cast<int>(data.map->basis.size());
  for (const MaterialFit& fit : exported.fits) row.fit_errors.push_back(fit.error);
  row.rmse_map = error_of(views, data, Method::kMap);
  row.rmse_materials = error_of(views, data, Method::kMap, exported.materials);
  row.rmse_one_material = error_of(views, data, Method::kMap, exported.one);
  row.rmse_64 = error_of(views, data, Method::kSupersample);
  row.reference_residual = between_halves.interior() / 2;
  return row;
}

std::vector<std::string> shaders_of(const ExportBenchOptions& options) {
  if (!options.shaders.empty()) return options.shaders;
  std::vector<std::string> names;
  for (const std::string& name : library_shader_names())
    if (!library_shader_info(name).varies_in_time) names.push_back(name);
  return names;
}

}  // namespace

std::vector<ExportBenchRow> measure_exports(const ExportBenchOptions& options) {
  const std::vector<std::string> shaders = shaders_of(options);
  for (const std::string& name : shaders) library_shader_info(name);
  std::vector<ExportBenchRow> rows;
  double done = 0;
  for (const std::string& object : options.objects) {
    const auto surface = make_bench_surface(object, options.models);
    for (const std::string& name : shaders) {
      const std::shared_ptr<const Shader> shader = make_library_shader(name);
      const ObjectData data = bake_data(*surface, *shader, options);
      const Exported exported = export_all(data, *shader);
      for (double minification : options.minifications) {
        if (options.cancelled && options.cancelled()) throw Error("the bench was cancelled");
        rows.push_back(measure(surface, shader, data, exported, minification, options));
        rows.back().object = object;
      }
      if (options.progress) options.progress(++done / static_cast<double>(options.objects.size() * shaders.size()));
    }
  }
  return rows;
}

}  // namespace redmap::bench
