// Wavefront OBJ through tinyobjloader, which triangulates polygons and resolves negative indices. It reads what it can
// and guesses the rest, so every line of geometry is checked first.
#include <tiny_obj_loader.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

constexpr std::string_view kBlanks = " \t\r";

/// The next word of `line`, taken off its front; empty at its end.
std::string_view take_word(std::string_view& line) {
  const std::size_t start = std::min(line.find_first_not_of(kBlanks), line.size());
  const std::size_t end = std::min(line.find_first_of(kBlanks, start), line.size());
  const std::string_view word = line.substr(start, end - start);
  line.remove_prefix(end);
  return word;
}

/// Counts what has been declared so far and checks one line at a time.
class LineChecker {
 public:
  explicit LineChecker(const std::filesystem::path& path) : path_(path) {}

  void check(std::string_view line, int number) {
    line_ = line, number_ = number;
    const std::string_view keyword = take_word(line);
    if (keyword == "v") check_numbers(line, 3), ++counts_[0];
    if (keyword == "vt") check_numbers(line, 2), ++counts_[1];
    if (keyword == "vn") check_numbers(line, 3), ++counts_[2];
    if (keyword == "f") check_face(line);
  }

 private:
  void check_numbers(std::string_view rest, int expected) const {
    for (int i = 0; i < expected; ++i) {
      const std::string_view word = take_word(rest);
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        fail(fmt::format("{} finite numbers", expected), word);
    }
  }

  void check_face(std::string_view rest) const {
    int corners = 0;
    for (std::string_view word = take_word(rest); !word.empty() && word[0] != '#'; word = take_word(rest), ++corners)
      check_corner(word);
    if (corners < 3) fail("a face of 3 corners or more", fmt::format("{}", corners));
  }

  /// v, v/t, v//n or v/t/n.
  void check_corner(std::string_view word) const {
    static constexpr const char* kKinds[3] = {"vertex", "uv", "normal"};
    std::string_view rest = word;
    for (int kind = 0; kind < 3 && (kind == 0 || !rest.empty()); ++kind) {
      const std::string_view field = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(field.size() + 1, rest.size()));
      if (field.empty() && kind == 1) continue;
      long long index = 0;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), index);
      const bool whole = error == std::errc{} && end == field.data() + field.size();
      if (!whole || index == 0 || index > counts_[kind] || index < -counts_[kind])
        fail(fmt::format("a {} index from 1 to {}", kKinds[kind], counts_[kind]), word);
    }
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error("{}:{}: expected {}, found \"{}\" in \"{}\"", path_.string(), number_, expected, found,
                line_.substr(0, 60));
  }

  const std::filesystem::path& path_;
  std::string_view line_;
  int number_ = 0;
  long long counts_[3] = {0, 0, 0};
};

void check_lines(const std::filesystem::path& path, std::string_view text) {
  LineChecker checker(path);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    checker.check(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

TriangleMesh read_obj(const std::filesystem::path& path) {
  const std::string text = read_bytes(path);
  check_lines(path, text);
  tinyobj::ObjReaderConfig config;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, "", config))
    throw Error("{}: not a sound OBJ file: {}", path.string(), reader.Error());

  TriangleMesh mesh;
  const tinyobj::attrib_t& attributes = reader.GetAttrib();
  const auto& v = attributes.vertices;
  const auto& vt = attributes.texcoords;
  const auto& vn = attributes.normals;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) mesh.positions.push_back({v[i], v[i + 1], v[i + 2]});
  for (std::size_t i = 0; i + 1 < vt.size(); i += 2) mesh.uv.push_back({vt[i], vt[i + 1]});
  for (std::size_t i = 0; i + 2 < vn.size(); i += 3) mesh.normals.push_back({vn[i], vn[i + 1], vn[i + 2]});
  bool has_uv = true, has_normals = true;
  for (const tinyobj::shape_t& shape : reader.GetShapes())
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      Triangle position, uv, normal;
      for (int k = 0; k < 3; ++k) {
        const tinyobj::index_t index = shape.mesh.indices[i + k];
        position[k] = index.vertex_index, uv[k] = index.texcoord_index, normal[k] = index.normal_index;
        has_uv &= index.texcoord_index >= 0, has_normals &= index.normal_index >= 0;
      }
      mesh.triangles.push_back(position), mesh.uv_triangles.push_back(uv), mesh.normal_triangles.push_back(normal);
    }
  // Attributes that only some faces have are of no use.
  if (!has_uv) mesh.uv.clear(), mesh.uv_triangles.clear();
  if (!has_normals) mesh.normals.clear(), mesh.normal_triangles.clear();
  return mesh;
}

}  // namespace redmap
