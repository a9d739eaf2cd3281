// tinygltf refuses the index accessors of compressed primitives, which have no data: so the text is read once before,
// and the indices that Draco brings are taken out.
#define TINYGLTF_IMPLEMENTATION
#include "surface/gltf_document.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

constexpr std::size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;
static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

/// The text without the indices of compressed primitives; unchanged if it is no JSON, which tinygltf will say better.
std::string prepare_json(const std::filesystem::path& path, std::string_view text) {
  nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (!document.is_object()) return std::string(text);
  const auto found = [&](const nlohmann::json& table, const char* key) {
    return table.is_object() && table.contains(key) ? table[key] : nlohmann::json();
  };
  const nlohmann::json version = found(found(document, "asset"), "version");
  if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2."))
    throw Error("{}: expected glTF 2.0, found {}", path.string(),
                version.is_string() ? "version " + version.get<std::string>() : "a file without asset.version");
  if (!document.contains("meshes") || !document["meshes"].is_array()) return std::string(text);
  for (nlohmann::json& mesh : document["meshes"]) {
    if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
    for (nlohmann::json& primitive : mesh["primitives"])
      if (found(found(primitive, "extensions"), "KHR_draco_mesh_compression").is_object()) primitive.erase("indices");
  }
  return document.dump();
}

/// The same file with its JSON prepared; unchanged if it is no GLB, which tinygltf will say better.
std::string prepare_glb(const std::filesystem::path& path, const std::string& bytes) {
  std::uint32_t json_bytes = 0;
  constexpr std::size_t kJsonStart = kGlbHeaderBytes + kChunkHeaderBytes;
  if (bytes.size() < kJsonStart || !bytes.starts_with("glTF")) return bytes;
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + 4, sizeof version);
  if (version != 2) throw Error("{}: expected binary glTF 2, found version {}", path.string(), version);
  std::memcpy(&json_bytes, bytes.data() + kGlbHeaderBytes, sizeof json_bytes);
  if (bytes.size() - kJsonStart < json_bytes) return bytes;
  std::string json = prepare_json(path, std::string_view(bytes).substr(kJsonStart, json_bytes));
  // Chunks are whole words.
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string result = bytes.substr(0, kJsonStart) + json + bytes.substr(kJsonStart + json_bytes);
  std::uint32_t total = 0;
  std::memcpy(&total, bytes.data() + 8, sizeof total);
  // What the header says may be wrong, and stays as wrong as it was.
  total += static_cast<std::uint32_t>(json.size()) - json_bytes;
  json_bytes = static_cast<std::uint32_t>(json.size());
  std::memcpy(result.data() + 8, &total, sizeof total);
  std::memcpy(result.data() + kGlbHeaderBytes, &json_bytes, sizeof json_bytes);
  return result;
}

/// Pictures are no part of a mesh: left unread.
bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

}  // namespace

tinygltf::Model load_gltf(const std::filesystem::path& path, bool binary) {
  const std::string file = read_bytes(path);
  const std::string bytes = binary ? prepare_glb(path, file) : prepare_json(path, file);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(skip_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const std::string folder = path.parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool sound =
      binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
             : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  if (sound) return model;
  std::replace(error.begin(), error.end(), '\n', ' ');
  throw Error("{}: expected sound glTF, found: {}", path.string(), error.empty() ? "something else" : error);
}

}  // namespace redmap
