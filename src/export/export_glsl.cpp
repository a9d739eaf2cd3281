// The whole map for somebody else's program: one include file in GLSL, which OpenGL 3.3, Vulkan and WebGL2 take, and
// two files of numbers. The text is that of our own kernels (src/gpu/kernels), with another way to memory.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "export/export.h"
#include "export/glsl_text.h"
#include "export/gzip.h"
#include "export/live_parameters.h"
#include "export/manifest.h"
#include "export/mesh_buffers.h"
#include "gpu/kernel_texts.h"
#include "gpu/limits_text.h"
#include "gpu/map_memory.h"
#include "gpu/object_text.h"
#include "user_shader/device_shader.h"

namespace redmap {

namespace {

/// Words in a row of the texture of words, as redmap_word() has it.
constexpr std::size_t kWordsARow = 2048;

std::string number(float value) {
  const std::string text = fmt::format("{:.9g}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}
std::string vec4_text(const Vec4& v) {
  return fmt::format("vec4({}, {}, {}, {})", number(v.x), number(v.y), number(v.z), number(v.w));
}

/// The struct Parameters, as a constant.
std::string parameters_text(const Shader& shader) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < shader.parameters().size(); ++i) {
    const std::string& type = shader.info().parameters[i].type;
    std::vector<std::string> components;
    for (const float value : shader.parameters()[i])
      components.push_back(type == "int" ? fmt::format("{}", static_cast<int>(value)) : number(value));
    const std::string all = fmt::format("{}", fmt::join(components, ", "));
    values.push_back(components.size() > 1 ? fmt::format("{}({})", type, all) : all);
  }
  return fmt::format("Parameters redmap_parameters = Parameters({});\n", fmt::join(values, ", "));
}

std::string constants_text(const ExportInput& input, const ObjectTraits& traits) {
  ObjectBlock block;
  set_map_block(*input.map, traits.is_fast, block);
  std::string text = trait_definitions(traits);
  text += fmt::format("const vec4 redmap_map = {};\n", vec4_text(block.map));
  std::vector<std::string> scales;
  for (const Vec4& scale : block.scales) scales.push_back(vec4_text(scale));
  return text +
         fmt::format("const vec4 redmap_scales[{0}] = vec4[{0}]({1});\n", scales.size(), fmt::join(scales, ", "));
}

/// Without `#line`, whose files nobody else knows.
std::string without_lines(const std::string& text) {
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (!line.starts_with("#line")) result += line + "\n";
    at = end + 1;
  }
  return result;
}

std::string include_text(const ExportInput& input, const DeviceShader& shader, const ObjectTraits& traits) {
  const ShaderInfo& info = input.shader->info();
  std::string text = fmt::format("// {}: the reduction map of shader '{}', by redmap. See docs/export.md of redmap.\n",
                                 input.name, info.name);
  text += std::string(kGlslBefore) + limits_text() + constants_text(input, traits) + shader_text_head(info);
  text += kernel_texts({"hit_type", "footprint", "place", "lookup", "lobes"});
  text += map_parts_text(traits);
  text += shader_text_body(shader.sources, info, 0);
  text += parameters_text(*input.shader) + std::string(kGlslPatterns) + kernel_texts({"bind", "shade", "unmixed"});
  text += kernel_texts({"shade_map", "shade_spread", traits.has_normals ? "shade_normals" : "shade_turning"});
  return without_lines(text + std::string(kGlslAfter));
}

/// What is declared of each parameter, its value in the bake, and whether the map holds for others.
Json parameters_json(const ExportInput& input) {
  const std::vector<bool> live = live_parameters(*input.map, *input.surface, *input.shader);
  Json all = Json::array();
  for (std::size_t i = 0; i < live.size(); ++i) {
    const ParameterInfo& info = input.shader->info().parameters[i];
    all.push_back({{"name", info.name},
                   {"type", info.type},
                   {"value", input.shader->parameters()[i]},
                   {"minimum", info.minimum},
                   {"maximum", info.maximum},
                   {"unit", info.unit},
                   {"meaning", info.meaning},
                   {"live", static_cast<bool>(live[i])}});
  }
  return all;
}

/// Writes a file, and beside it the same compressed where that was asked for; returns its entry in the manifest.
Json add_file(const std::string& name, std::string_view bytes, Compression compression, ExportFolder& folder) {
  folder.add(name, bytes);
  Json entry{{"file", name}};
  if (compression == Compression::kGzip) {
    folder.add(name + ".gz", gzip(bytes));
    entry["gzip"] = name + ".gz";
  }
  return entry;
}

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

void export_glsl(const ExportInput& input, Compression compression, ExportFolder& folder) {
  if (!input.surface) throw Error("export: GLSL needs the surface of the map, found no scene: name it with --scene");
  const ShaderInfo& info = input.shader->info();
  const std::optional<DeviceShader> shader = device_shader(*input.shader);
  if (!shader) throw Error("export: expected a shader in GLSL, found the plug-in '{}'", info.name);
  if (info.transmits || !info.images.empty())
    throw Error("export: expected an opaque shader without images for GLSL, found '{}'", info.name);
  ObjectTraits traits;
  set_map_traits(*input.map, *input.surface, traits);
  folder.add("redmap.glsl", include_text(input, *shader, traits));

  Json manifest = manifest_of(input, "glsl");
  manifest["include"] = "redmap.glsl";
  const WeightTexels weights = weight_texels(*input.map);
  const Extent extent = input.map->weights.extent(0);
  manifest["weights"] = add_file("weights.bin", bytes_of(weights.texels), compression, folder);
  manifest["weights"].update({{"width", extent.width},
                              {"height", extent.height},
                              {"layers", weights.layers},
                              {"levels", input.map->weights.levels()},
                              {"wraps_u", input.map->weights.wraps_u()}});
  std::vector<std::uint32_t> words = map_data(*input.map, *input.surface, traits);
  words.resize((words.size() + kWordsARow - 1) / kWordsARow * kWordsARow);
  manifest["words"] = add_file("words.bin", bytes_of(words), compression, folder);
  manifest["words"].update({{"width", kWordsARow}, {"height", words.size() / kWordsARow}});
  const MeshBuffers mesh = mesh_buffers(*input.surface);
  manifest["mesh"] = add_file("mesh.bin", mesh_bytes(mesh), compression, folder);
  manifest["mesh"].update({{"vertices", mesh.positions.size()}, {"indices", mesh.indices.size()}});
  manifest["parameters"] = parameters_json(input);
  add_manifest(manifest, folder);
}

}  // namespace redmap
