// From a file to a Shader: read, compiled, with its parameters and images.
#include "user_shader/user_shader.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "device/glsl_compiler.h"
#include "shader/parameter_values.h"
#include "user_shader/device_shader.h"
#include "user_shader/materialx.h"
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

/// Images that the scene names, and those that a MaterialX document names itself: it converts their colours, too.
std::map<std::string, ShaderImage> images_of(const std::filesystem::path& file, const UserShaderSettings& settings) {
  std::map<std::string, ShaderImage> images = settings.images;
  if (is_materialx(file))
    for (const auto& [name, image] : translate_materialx(file).images) images.emplace(name, ShaderImage{image, true});
  return images;
}

/// Fills in which files the images of the text are.
void set_images(const std::map<std::string, ShaderImage>& files, ShaderInfo& info) {
  std::vector<std::string> names;
  for (ShaderImageInfo& image : info.images) {
    names.push_back(image.name);
    const auto found = files.find(image.name);
    if (found == files.end())
      throw Error("shader \"{}\": expected a file for its image \"{}\", found none", info.name, image.name);
    image.file = found->second.file, image.is_data = found->second.is_data;
  }
  for (const auto& [name, image] : files)
    if (std::ranges::find(names, name) == names.end())
      throw Error("shader \"{}\": expected images {}, found \"{}\"", info.name,
                  names.empty() ? "to be none" : fmt::format("\"{}\"", fmt::join(names, "\", \"")), name);
}

}  // namespace

std::shared_ptr<const Shader> make_user_shader(const std::filesystem::path& file, const std::string& name,
                                               const UserShaderSettings& settings) {
  if (is_plugin(file)) return make_plugin_shader(file, name, settings);
  ShaderInfo info = user_shader_info(file, name);
  ParameterValues values = parameter_values(info, settings.parameters);
  set_images(images_of(file, settings), info);
  const ShaderSources sources = read_shader_sources(file);
  const ShaderSources text = stage_text(sources, info);
  std::vector<std::uint32_t> spirv = compile_glsl(text.text, text.names, kLoopGuard);
  std::vector<Image> images = read_shader_images(info);
  info.text_hash = shader_file_hash(sources, info);
  std::vector<std::byte> parameters = parameter_bytes(info, values);
  return std::make_shared<UserShader>(std::shared_ptr<const UserShaderParts>(
      new UserShaderParts{std::move(info), std::move(values),
                          ShaderProgram(std::move(spirv), std::move(parameters), std::move(images), settings.device)}));
}

}  // namespace redmap
