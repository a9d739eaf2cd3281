// A shader of the library or of a GLSL file as texts for a device need it: its own text, whatever its form, and what it
// is given.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "shader/shader.h"
#include "shader/shader_text.h"

namespace redmap {

struct DeviceShader {
  ShaderSources sources;              ///< without `#version`
  std::vector<std::byte> parameters;  ///< the struct Parameters, std430
  std::vector<Image> images;          ///< in the order of ShaderInfo::images
};

/// Nothing for plug-ins, and for shaders that are neither of the library nor a file. Throws Error where the file has
/// changed since `shader` was made from it.
std::optional<DeviceShader> device_shader(const Shader& shader);

/// What stands between `#version` and the shader's text: the prelude, REDMAP_BOUND (the type of what a shader is bound
/// to at a place), and REDMAP_BLACK_BOX, REDMAP_PERTURBS, REDMAP_TURNS (the row of a stage that tangents go to),
/// REDMAP_TRANSMITS, REDMAP_EMITS, REDMAP_HAS_MATERIAL where they apply. Black boxes are bound to a RedmapPlace.
std::string shader_text_head(const ShaderInfo& info);
/// The shader's text with its images at bindings `first_binding`, ... of set 0.
std::string shader_text_body(const ShaderSources& sources, const ShaderInfo& info, int first_binding);

/// The struct Parameters by the rules of std430: a vec3 takes three floats and starts at a fourth.
std::vector<std::byte> parameter_bytes(const ShaderInfo& info, const ParameterValues& values);
/// As shaders see it: linear light, numbers as they are in the file.
std::vector<Image> read_shader_images(const ShaderInfo& info);
/// ShaderInfo::text_hash of a file: text, includes and images.
std::uint64_t shader_file_hash(const ShaderSources& text, const ShaderInfo& info);

}  // namespace redmap
