// Shaders of the user's own: a file becomes a Shader like the library's (docs/bring_your_shader.md). It is a text in
// GLSL, NAME.glsl, a MaterialX document, NAME.mtlx, which becomes one, or a plug-in (plugin.h), NAME.so, which runs as
// it is.
//
// The text may use all of GLSL 4.50. It is compiled when it is loaded, and runs on a Vulkan device, which is opened
// when the shader first runs.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "shader/shader.h"

namespace redmap {

/// Which file a shader's `uniform sampler2D` samples.
struct ShaderImage {
  std::filesystem::path file;
  bool is_data = false;  ///< a PNG holds numbers (normals, roughness) and not colours: no sRGB curve is taken off
};

struct UserShaderSettings {
  ParameterOverrides parameters;
  std::map<std::string, ShaderImage> images;  ///< by the name of the sampler
  std::string device;                         ///< as in Device::open()
};

/// Whether `shader`, as a scene names it, is a file and not one of the library.
bool is_shader_file(const std::string& shader);

/// What the file declares. `name` is what maps, reports and errors call the shader. Throws Error "FILE:LINE: ...".
ShaderInfo user_shader_info(const std::filesystem::path& file, const std::string& name);

/// The shader of `file`, compiled. Throws Error "FILE:LINE:COLUMN: ..." for the first mistake in the text, and on
/// parameters and images that do not fit. What it returns throws Error where a function of the shader does not end, or
/// returns anything but finite numbers (and, for shading_normal, a unit vector), naming shader, function and place.
std::shared_ptr<const Shader> make_user_shader(const std::filesystem::path& file, const std::string& name,
                                               const UserShaderSettings& settings = {});

}  // namespace redmap
