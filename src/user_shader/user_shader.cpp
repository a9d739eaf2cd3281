// From a file to a Shader: read, compiled, with its parameters and images.
#include "user_shader/user_shader.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/srgb.h"
#include "device/glsl_compiler.h"
#include "shader/parameter_values.h"
#include "user_shader/plugin_shader.h"
#include "user_shader/shader_file.h"
#include "user_shader/user_patterns.h"

namespace redmap {
namespace {

class UserShader final : public Shader {
 public:
  explicit UserShader(std::shared_ptr<const UserShaderParts> shared) : shared_(std::move(shared)) {}
  const ShaderInfo& info() const override { return shared_->info; }
  const ParameterValues& parameters() const override { return shared_->values; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return bind_user_patterns(shared_, points);
  }

 private:
  std::shared_ptr<const UserShaderParts> shared_;
};

/// The struct Parameters by the rules of std430: a vec3 takes three floats and starts at a fourth.
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

/// Images are read as linear light; numbers come back as they are in the file.
Image read_shader_image(const ShaderImageInfo& info) {
  Image image = read_image(info.file);
  if (info.is_data && info.file.extension() == ".png")
    for (int c = 0; c < std::min(image.channels, 3); ++c)
      for (std::size_t i = c; i < image.data.size(); i += image.channels) image.data[i] = linear_to_srgb(image.data[i]);
  return image;
}

/// Fills in which files the images of the text are.
void set_images(const UserShaderSettings& settings, ShaderInfo& info) {
  std::vector<std::string> names;
  for (ShaderImageInfo& image : info.images) {
    names.push_back(image.name);
    const auto found = settings.images.find(image.name);
    if (found == settings.images.end())
      throw Error("shader \"{}\": expected a file for its image \"{}\", found none", info.name, image.name);
    image.file = found->second.file, image.is_data = found->second.is_data;
  }
  for (const auto& [name, image] : settings.images)
    if (std::ranges::find(names, name) == names.end())
      throw Error("shader \"{}\": expected images {}, found \"{}\"", info.name,
                  names.empty() ? "to be none" : fmt::format("\"{}\"", fmt::join(names, "\", \"")), name);
}

std::uint64_t hash_of(const ShaderSources& text, const ShaderInfo& info) {
  std::uint64_t hash = hash_bytes(0, text.text.data(), text.text.size());
  for (const ShaderImageInfo& image : info.images) {
    const std::string bytes = read_file(image.file);
    hash = hash_bytes(hash64(hash, static_cast<std::uint64_t>(image.is_data)), bytes.data(), bytes.size());
  }
  return hash;
}

}  // namespace

std::shared_ptr<const Shader> make_user_shader(const std::filesystem::path& file, const std::string& name,
                                               const UserShaderSettings& settings) {
  if (is_plugin(file)) return make_plugin_shader(file, name, settings);
  ShaderInfo info = user_shader_info(file, name);
  ParameterValues values = parameter_values(info, settings.parameters);
  set_images(settings, info);
  const ShaderSources sources = read_shader_sources(file);
  const ShaderSources text = stage_text(sources, info);
  std::vector<std::uint32_t> spirv = compile_glsl(text.text, text.names, kLoopGuard);
  std::vector<Image> images;
  for (const ShaderImageInfo& image : info.images) images.push_back(read_shader_image(image));
  info.text_hash = hash_of(sources, info);
  std::vector<std::byte> parameters = parameter_bytes(info, values);
  return std::make_shared<UserShader>(std::shared_ptr<const UserShaderParts>(
      new UserShaderParts{std::move(info), std::move(values),
                          ShaderProgram(std::move(spirv), std::move(parameters), std::move(images), settings.device)}));
}

}  // namespace redmap
