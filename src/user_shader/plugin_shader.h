// A plug-in (plugin.h) as a Shader. Not part of the public interface.
#pragma once

#include "user_shader/user_shader.h"

namespace redmap {

/// What user_shader_info() and make_user_shader() do with shared libraries. They throw Error on what cannot be loaded,
/// exports no redmap_plugin(), is of another version of the interface, or lacks a function.
ShaderInfo plugin_info(const std::filesystem::path& file, const std::string& name);
std::shared_ptr<const Shader> make_plugin_shader(const std::filesystem::path& file, const std::string& name,
                                                 const UserShaderSettings& settings);

}  // namespace redmap
