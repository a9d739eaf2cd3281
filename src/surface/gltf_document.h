// A glTF or GLB file as tinygltf's model.
#pragma once

#include <filesystem>

// libdraco exports a tinygltf of its own, built differently: ours is compiled by us and goes by another name.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define tinygltf redmap_tinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace redmap {

namespace tinygltf = ::redmap_tinygltf;

/// Reads the file with its buffers, and without its pictures. Throws Error unless it is sound glTF 2.
tinygltf::Model load_gltf(const std::filesystem::path& path, bool binary);

/// Replaces sparse accessors by plain ones with the same values, in buffers of their own. Throws Error where they do
/// not fit the file.
void fill_sparse_accessors(const std::filesystem::path& path, tinygltf::Model& model);

}  // namespace redmap
