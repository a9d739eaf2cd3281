// glTF 2.0 (Khronos, ISO/IEC 12113): the object with one averaged material that any viewer draws; masks, fitted
// materials and the files that have all levels are named in its extras.
#include <fmt/format.h>

#include <cstring>

#include "base/error.h"
#include "export/export.h"
#include "export/ktx2.h"
#include "export/manifest.h"
#include "export/mesh_buffers.h"

namespace redmap {

namespace {

// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinearMipmapLinear = 9987, kLinear = 9729, kRepeat = 10497, kClampToEdge = 33071;

class GltfWriter {
 public:
  GltfWriter(const ExportInput& input, ExportFolder& folder) : input_(input), folder_(folder) {
    const int wrap_u = input.map->weights.wraps_u() ? kRepeat : kClampToEdge;
    json_["asset"] = {{"version", "2.0"}, {"generator", "redmap"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    json_["nodes"] = Json::array({{{"mesh", 0}, {"name", input.name}}});
    json_["samplers"] = Json::array(
        {{{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", wrap_u}, {"wrapT", kClampToEdge}}});
    json_["materials"] = Json::array();
  }

  void add_mesh(const Surface& surface);
  /// Returns its index. The base as PNG, all levels as KTX2 beside it.
  int add_texture(const Texture& texture);
  /// Returns its index.
  int add_material(Json material) {
    json_["materials"].push_back(std::move(material));
    return static_cast<int>(json_["materials"].size()) - 1;
  }
  void use_extension(const std::string& name) {
    for (const Json& used : json_["extensionsUsed"])
      if (used == name) return;
    json_["extensionsUsed"].push_back(name);
  }
  void set_extras(const Json& extras) { json_["extras"] = {{"redmap", extras}}; }
  void write();

 private:
  template <typename T>
  int add_accessor(const std::vector<T>& values, const char* type, int component, int target);

  const ExportInput& input_;
  ExportFolder& folder_;
  Json json_;
  std::string buffer_;
};

template <typename T>
int GltfWriter::add_accessor(const std::vector<T>& values, const char* type, int component, int target) {
  const std::size_t bytes = values.size() * sizeof(T);
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes}, {"target", target}});
  buffer_.append(reinterpret_cast<const char*>(values.data()), bytes);
  json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                {"componentType", component},
                                {"count", values.size()},
                                {"type", type}});
  return static_cast<int>(json_["accessors"].size()) - 1;
}

void GltfWriter::add_mesh(const Surface& surface) {
  MeshBuffers mesh = mesh_buffers(surface);
  for (auto& uv : mesh.uv) uv[1] = 1 - uv[1];  // glTF's v points down
  const int positions = add_accessor(mesh.positions, "VEC3", kFloat, kArrayBuffer);
  json_["accessors"][positions]["min"] = {mesh.lower.x, mesh.lower.y, mesh.lower.z};
  json_["accessors"][positions]["max"] = {mesh.upper.x, mesh.upper.y, mesh.upper.z};
  const Json attributes{{"POSITION", positions},
                        {"NORMAL", add_accessor(mesh.normals, "VEC3", kFloat, kArrayBuffer)},
                        {"TANGENT", add_accessor(mesh.tangents, "VEC4", kFloat, kArrayBuffer)},
                        {"TEXCOORD_0", add_accessor(mesh.uv, "VEC2", kFloat, kArrayBuffer)}};
  const int indices = add_accessor(mesh.indices, "SCALAR", kUnsignedInt, kElementArrayBuffer);
  const Json primitive{{"attributes", attributes}, {"indices", indices}, {"material", 0}};
  json_["meshes"] = Json::array({{{"name", input_.name}, {"primitives", Json::array({primitive})}}});
}

int GltfWriter::add_texture(const Texture& texture) {
  const std::string file = texture.name + ".png";
  folder_.add(file, png_bytes(texture));
  folder_.add(texture.name + ".ktx2", ktx2_bytes(texture));
  json_["images"].push_back({{"uri", file}, {"name", texture.name}});
  json_["textures"].push_back({{"source", json_["images"].size() - 1}, {"sampler", 0}});
  return static_cast<int>(json_["textures"].size()) - 1;
}

void GltfWriter::write() {
  const std::string file = input_.name + ".bin";
  folder_.add(file, buffer_);
  json_["buffers"] = Json::array({{{"uri", file}, {"byteLength", buffer_.size()}}});
  folder_.add(input_.name + ".gltf", json_.dump(1) + "\n");
}

Json rgb_json(Rgb c) { return Json::array({c.r, c.g, c.b}); }

/// Emission above 1 needs an extension.
void set_emission(Rgb emission, Json& material, GltfWriter& writer) {
  const float strength = std::max({emission.r, emission.g, emission.b, 1.0f});
  material["emissiveFactor"] = rgb_json(emission * (1 / strength));
  if (strength <= 1) return;
  material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
  writer.use_extension("KHR_materials_emissive_strength");
}

void set_extension(const char* name, Json values, Json& material, GltfWriter& writer) {
  material["extensions"][name] = std::move(values);
  writer.use_extension(name);
}

int add_averaged(const ExportInput& input, const OneMaterial& one, GltfWriter& writer) {
  Json material{{"name", input.name}};
  material["pbrMetallicRoughness"] = {
      {"baseColorTexture", {{"index", writer.add_texture(one.base_color)}}},
      {"metallicRoughnessTexture", {{"index", writer.add_texture(one.metallic_roughness)}}}};
  if (one.normal) material["normalTexture"] = {{"index", writer.add_texture(*one.normal)}};
  if (one.emission) {
    set_emission(one.emission_scale, material, writer);
    material["emissiveTexture"] = {{"index", writer.add_texture(*one.emission)}};
  }
  if (one.anisotropy)
    set_extension("KHR_materials_anisotropy",
                  {{"anisotropyStrength", 1}, {"anisotropyTexture", {{"index", writer.add_texture(*one.anisotropy)}}}},
                  material, writer);
  if (one.specular < 1) set_extension("KHR_materials_specular", {{"specularFactor", one.specular}}, material, writer);
  if (one.transmission)
    set_extension(
        "KHR_materials_transmission",
        {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", writer.add_texture(*one.transmission)}}}},
        material, writer);
  return writer.add_material(std::move(material));
}

int add_fitted(const std::string& name, const GltfMaterial& m, int normal_texture, GltfWriter& writer) {
  Json material{{"name", name}};
  material["pbrMetallicRoughness"] = {{"baseColorFactor", {m.base_color.r, m.base_color.g, m.base_color.b, 1}},
                                      {"metallicFactor", m.metallic},
                                      {"roughnessFactor", m.roughness}};
  set_extension("KHR_materials_specular",
                {{"specularFactor", m.specular}, {"specularColorFactor", rgb_json(m.specular_color)}}, material,
                writer);
  if (normal_texture >= 0) material["normalTexture"] = {{"index", normal_texture}};
  if (m.coat > 0)
    set_extension("KHR_materials_clearcoat",
                  {{"clearcoatFactor", m.coat}, {"clearcoatRoughnessFactor", m.coat_roughness}}, material, writer);
  if (m.anisotropy > 0)
    set_extension("KHR_materials_anisotropy",
                  {{"anisotropyStrength", m.anisotropy}, {"anisotropyRotation", m.anisotropy_rotation}}, material,
                  writer);
  if (m.transmission > 0)
    set_extension("KHR_materials_transmission", {{"transmissionFactor", m.transmission}}, material, writer);
  if (m.emission.r + m.emission.g + m.emission.b > 0) set_emission(m.emission, material, writer);
  return writer.add_material(std::move(material));
}

/// Masks three to a picture, and a material each. PNG's alpha would be taken for coverage by some readers.
void add_masked(const ExportInput& input, int normal_texture, GltfWriter& writer, Json& manifest) {
  constexpr std::size_t kPerPicture = 3;
  const Masks masks = mask_textures(*input.map);
  std::vector<int> textures;
  for (std::size_t first = 0; first < masks.textures.size(); first += kPerPicture) {
    std::vector<const Texture*> parts;
    for (std::size_t b = first; b < std::min(first + kPerPicture, masks.textures.size()); ++b)
      parts.push_back(&masks.textures[b]);
    textures.push_back(writer.add_texture(pack_channels(fmt::format("masks{}", textures.size()), parts, 3)));
  }
  manifest["masks"] = masks_json(masks, [&](std::size_t b, Json& mask) {
    mask["texture"] = textures[b / kPerPicture], mask["file"] = fmt::format("masks{}.png", b / kPerPicture);
    mask["channel"] = b % kPerPicture;
    mask["material"] = add_fitted(fmt::format("{} {}", input.name, b), input.fits[b].material, normal_texture, writer);
  });
  if (const auto normals = normal_textures(*input.map)) {
    manifest["moments"] = {
        {"texture", writer.add_texture(normals->moments)}, {"file", "moments.png"}, {"scale", normals->scale}};
    manifest["normal_fine"] = {{"texture", writer.add_texture(normals->normal_fine)}, {"file", "normal_fine.png"}};
    manifest["moments"]["fine_texture"] = writer.add_texture(normals->moments_fine);
    manifest["moments"]["fine"] = "moments_fine.png";
  }
  if (const auto grain = grain_texture(*input.map))
    manifest["grain"] = {{"texture", writer.add_texture(*grain)}, {"file", "grain.png"}};
}

}  // namespace

void export_gltf(const ExportInput& input, MaterialCount count, ExportFolder& folder) {
  if (!input.surface) throw Error("export: glTF needs the surface of the map, found no scene: name it with --scene");
  GltfWriter writer(input, folder);
  writer.add_mesh(*input.surface);
  const OneMaterial one = average_material(*input.map, input.fits);
  Json manifest = manifest_of(input, "gltf");
  manifest["gltf"] = input.name + ".gltf";
  const int averaged = add_averaged(input, one, writer);
  manifest["one_material"] = averaged;
  // Textures were added in the order of add_averaged().
  if (count == MaterialCount::kOneABasis) add_masked(input, one.normal ? 2 : -1, writer, manifest);
  writer.set_extras(manifest);
  writer.write();
  add_manifest(manifest, folder);
}

}  // namespace redmap
