// MaterialX documents as shaders: MaterialX's own generator writes the GLSL, through its Python module, and
// python/redmap/materialx.py puts that into the contract of docs/bring_your_shader.md. Not part of the public
// interface.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace redmap {

struct MaterialxShader {
  std::string text;
  std::map<std::string, std::string> images;  ///< file by the name of the sampler
};

/// Whether `file` is a MaterialX document.
/// FILE.mtlx of a shader "FILE.mtlx#MATERIAL"; other files as they are.
std::filesystem::path materialx_document(const std::filesystem::path& file);
bool is_materialx(const std::filesystem::path& file);

/// The shader of the material in `file`, of the one that it names or of the only one. The program $REDMAP_PYTHON, or
/// else python3, is asked once for every version of the file. Throws Error naming the file and what is not supported,
/// and where there is no Python with MaterialX.
MaterialxShader translate_materialx(const std::filesystem::path& file);

}  // namespace redmap
