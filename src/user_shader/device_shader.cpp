#include "user_shader/device_shader.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/srgb.h"
#include "user_shader/shader_file.h"

namespace redmap {
namespace {

constexpr std::string_view kPlace = R"(
// What a black box is bound to: the place and its shading frame.
struct RedmapPlace {
  Surface at;
  vec3 normal;
  vec3 tangent;
};
vec3 redmap_to_object(RedmapPlace redmap_m, vec3 redmap_v) {
  return redmap_m.tangent * redmap_v.x + cross(redmap_m.normal, redmap_m.tangent) * redmap_v.y +
         redmap_m.normal * redmap_v.z;
}
// The little of the other normal counts only where the tangent is the shading normal.
RedmapPlace redmap_framed(Surface redmap_at, vec3 redmap_n, vec3 redmap_t) {
  vec3 redmap_along = redmap_t - redmap_n * dot(redmap_n, redmap_t);
  return RedmapPlace(redmap_at, redmap_n, normalize(redmap_along + redmap_at.normal * 1e-6));
}
)";

Image read_shader_image(const ShaderImageInfo& info) {
  Image image = read_image(info.file);
  if (info.is_data && info.file.extension() != ".exr")
    for (int c = 0; c < std::min(image.channels, 3); ++c)
      for (std::size_t i = c; i < image.data.size(); i += image.channels) image.data[i] = linear_to_srgb(image.data[i]);
  return image;
}

/// The text of a library shader that `info` is of; nothing if it is of none.
std::optional<ShaderSources> library_sources(const ShaderInfo& info) {
  if (std::ranges::count(library_shader_names(), info.name) == 0) return std::nullopt;
  if (library_shader_info(info.name).text_hash != info.text_hash) return std::nullopt;
  return ShaderSources{library_shader_text(info.name), {info.name + ".glsl"}};
}

}  // namespace

std::vector<std::byte> parameter_bytes(const ShaderInfo& info, const ParameterValues& values) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t count = values[i].size(), alignment = sizeof(float) * (count == 3 ? 4 : count);
    bytes.resize((bytes.size() + alignment - 1) / alignment * alignment);
    for (const float value : values[i]) {
      const std::int32_t whole = static_cast<std::int32_t>(value);
      const void* from = info.parameters[i].type == "int" ? static_cast<const void*>(&whole) : &value;
      bytes.resize(bytes.size() + sizeof value);
      std::memcpy(&bytes[bytes.size() - sizeof value], from, sizeof value);
    }
  }
  bytes.resize((bytes.size() + 15) / 16 * 16);  // the struct is as long as a multiple of its widest member
  return bytes;
}

std::vector<Image> read_shader_images(const ShaderInfo& info) {
  std::vector<Image> images;
  for (const ShaderImageInfo& image : info.images) images.push_back(read_shader_image(image));
  return images;
}

std::uint64_t shader_file_hash(const ShaderSources& text, const ShaderInfo& info) {
  std::uint64_t hash = hash_bytes(0, text.text.data(), text.text.size());
  for (const ShaderImageInfo& image : info.images) {
    const std::string bytes = read_file(image.file);
    hash = hash_bytes(hash64(hash, static_cast<std::uint64_t>(image.is_data)), bytes.data(), bytes.size());
  }
  return hash;
}

std::optional<DeviceShader> device_shader(const Shader& shader) {
  const ShaderInfo& info = shader.info();
  std::optional<ShaderSources> sources;
  if (info.file.empty()) {
    sources = library_sources(info);
  } else if (!is_plugin(info.file)) {
    sources = read_shader_sources(info.file);
    if (shader_file_hash(*sources, info) != info.text_hash)
      throw Error("{}: expected the file as it was when it was loaded, found a newer one", info.file.string());
  }
  if (!sources) return std::nullopt;
  return DeviceShader{std::move(*sources), parameter_bytes(info, shader.parameters()), read_shader_images(info)};
}

std::string shader_text_head(const ShaderInfo& info) {
  std::string lines = *library_include("include/prelude.glsl");
  lines += fmt::format("#define REDMAP_BOUND {}\n", info.black_box ? "RedmapPlace" : "Pattern");
  if (info.black_box) lines += "#define REDMAP_BLACK_BOX\n";
  if (info.perturbs_normals) lines += "#define REDMAP_PERTURBS\n";
  if (info.turns_tangents) lines += fmt::format("#define REDMAP_TURNS {}u\n", info.perturbs_normals ? 3 : 0);
  if (info.transmits) lines += "#define REDMAP_TRANSMITS\n";
  if (info.emits) lines += "#define REDMAP_EMITS\n";
  if (info.has_material) lines += "#define REDMAP_HAS_MATERIAL\n";
  return lines + std::string(kPlace);
}

std::string shader_text_body(const ShaderSources& sources, const ShaderInfo& info, int first_binding) {
  std::string result;
  std::istringstream stream(sources.text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = std::min(line.find("uniform"), line.size());
    char name[256] = "";
    if (std::sscanf(line.c_str() + at, "uniform sampler2D %255[A-Za-z0-9_]", name) == 1) {
      const auto found = std::ranges::find(info.images, name, &ShaderImageInfo::name);
      if (found != info.images.end())
        line.insert(at, fmt::format("layout(binding = {}) ", first_binding + (found - info.images.begin())));
    }
    result += line + "\n";
  }
  return result;
}

}  // namespace redmap
