#include "export/manifest.h"

namespace redmap {

namespace {

Json array_of(Rgb c) { return Json::array({c.r, c.g, c.b}); }

}  // namespace

Json json_of(const GltfMaterial& m) {
  return {{"base_color", array_of(m.base_color)},
          {"metallic", m.metallic},
          {"roughness", m.roughness},
          {"specular", m.specular},
          {"specular_color", array_of(m.specular_color)},
          {"coat", m.coat},
          {"coat_roughness", m.coat_roughness},
          {"anisotropy", m.anisotropy},
          {"anisotropy_rotation", m.anisotropy_rotation},
          {"transmission", m.transmission},
          {"emission", array_of(m.emission)}};
}

Json manifest_of(const ExportInput& input, const std::string& kind) {
  const Extent extent = input.map->weights.extent(0);
  Json manifest{{"redmap_export", 1},
                {"kind", kind},
                {"name", input.name},
                {"shader", input.map->shader},
                {"basis", input.map->basis.size()},
                {"size", {extent.width, extent.height}},
                {"levels", input.map->weights.levels()}};
  Json materials = Json::array();
  for (const MaterialFit& fit : input.fits) {
    Json material = json_of(fit.material);
    material["fit_error"] = fit.error, material["fit_is_poor"] = fit.is_poor();
    materials.push_back(std::move(material));
  }
  manifest["materials"] = std::move(materials);
  return manifest;
}

void add_one_material(const ExportInput& input, const std::function<std::string(const Texture&)>& add, Json& manifest) {
  const OneMaterial one = average_material(*input.map, input.fits);
  Json files{{"base_color", add(one.base_color)},
             {"metallic_roughness", add(one.metallic_roughness)},
             {"specular", one.specular}};
  if (one.emission) files["emission"] = add(*one.emission), files["emission_scale"] = one.emission_scale.r;
  if (one.transmission) files["transmission"] = add(*one.transmission);
  if (const auto normals = normal_textures(*input.map)) {
    files["normal"] = add(normals->normal);
    manifest["normal_fine"] = {{"file", add(normals->normal_fine)}};
    manifest["moments"] = {
        {"file", add(normals->moments)}, {"fine", add(normals->moments_fine)}, {"scale", normals->scale}};
  }
  if (one.anisotropy) files["anisotropy"] = add(*one.anisotropy);
  if (const auto grain = grain_texture(*input.map)) manifest["grain"] = {{"file", add(*grain)}};
  manifest["one_material"] = std::move(files);
}

void add_manifest(const Json& manifest, ExportFolder& folder) {
  folder.add(ExportFolder::kManifest, manifest.dump(2) + "\n");
}

}  // namespace redmap
