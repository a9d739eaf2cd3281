// Wavefront OBJ, line by line: polygons, negative indices, separate indices for positions, uv and normals, groups and
// materials as parts. What is no geometry (lines, points, curves, material files) is passed over.
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "base/error.h"
#include "surface/mesh_files.h"
#include "surface/triangulate.h"

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

std::string_view trimmed(std::string_view text) {
  const std::size_t start = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(start, text.find_last_not_of(kBlanks) + 1 - start);
}

/// One polygon corner: position, uv, normal; kNone where not given.
using Corner = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = ~0u;

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const std::vector<Vec3>* shape) : path_(path), shape_(shape) {}

  TriangleMesh read(std::string_view text) {
    std::string joined;
    for (number_ = 1; !text.empty(); ++number_) {
      std::string_view line = take_line(text);
      // A backslash at its end continues a line.
      if (joined.empty() && !trimmed(line).ends_with('\\')) {
        read_line(line);
        continue;
      }
      joined += line.substr(0, line.find_last_not_of("\\ \t\r") + 1);
      joined += ' ';
      if (!trimmed(line).ends_with('\\')) read_line(joined), joined.clear();
    }
    if (!joined.empty()) read_line(joined);
    finish();
    return std::move(mesh_);
  }

 private:
  static std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
  }

  void read_line(std::string_view line) {
    line_ = line;
    const std::string_view keyword = take_word(line);
    if (keyword == "v") {
      mesh_.positions.push_back({number(line), number(line), number(line)});
    } else if (keyword == "vt") {
      const float u = number(line);
      mesh_.uv.push_back({u, trimmed(line).empty() ? 0 : number(line)});
    } else if (keyword == "vn") {
      mesh_.normals.push_back({number(line), number(line), number(line)});
    } else if (keyword == "f") {
      read_face(line);
    } else if (keyword == "o" || keyword == "g") {
      part_.group = trimmed(line);
    } else if (keyword == "usemtl") {
      part_.material = trimmed(line);
    }
  }

  float number(std::string_view& rest) const {
    const std::string_view word = take_word(rest);
    // from_chars knows no plus sign.
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
      fail("finite numbers", word);
    return static_cast<float>(value);
  }

  void read_face(std::string_view rest) {
    corners_.clear();
    for (std::string_view word = take_word(rest); !word.empty() && word[0] != '#'; word = take_word(rest))
      corners_.push_back(corner(word));
    if (corners_.size() < 3) fail("a face of 3 corners or more", fmt::format("{}", corners_.size()));
    add_polygon();
  }

  /// v, v/t, v//n or v/t/n.
  Corner corner(std::string_view word) const {
    static constexpr const char* kKinds[3] = {"vertex", "uv", "normal"};
    const std::size_t counts[3] = {mesh_.positions.size(), mesh_.uv.size(), mesh_.normals.size()};
    Corner result = {kNone, kNone, kNone};
    std::string_view rest = word;
    for (int kind = 0; kind < 3 && (kind == 0 || !rest.empty()); ++kind) {
      const std::string_view field = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(field.size() + 1, rest.size()));
      if (field.empty() && kind > 0) continue;
      long long index = 0;
      const auto count = static_cast<long long>(counts[kind]);
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), index);
      const bool whole = error == std::errc{} && end == field.data() + field.size();
      if (!whole || index == 0 || index > count || index < -count)
        fail(fmt::format("a {} index from 1 to {}", kKinds[kind], count), word);
      result[kind] = static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
    }
    return result;
  }

  void add_polygon() {
    const std::vector<Vec3>& shape = shape_ ? *shape_ : mesh_.positions;
    polygon_.clear();
    for (const Corner& corner : corners_)
      polygon_.push_back(corner[0] < shape.size() ? shape[corner[0]] : mesh_.positions[corner[0]]);
    triangulate(polygon_, cut_);
    for (const auto& [a, b, c] : cut_) {
      const auto pick = [&](int kind) { return Triangle{corners_[a][kind], corners_[b][kind], corners_[c][kind]}; };
      mesh_.triangles.push_back(pick(0)), mesh_.uv_triangles.push_back(pick(1));
      mesh_.normal_triangles.push_back(pick(2));
      mesh_.triangle_parts.push_back(part_number());
    }
  }

  std::uint32_t part_number() {
    const auto [found, is_new] =
        numbers_.try_emplace({part_.group, part_.material}, static_cast<std::uint32_t>(mesh_.parts.size()));
    if (is_new) mesh_.parts.push_back(part_);
    return found->second;
  }

  /// Attributes that only some faces have are of no use.
  void finish() {
    const auto is_partial = [](const std::vector<Triangle>& triangles) {
      for (const Triangle& t : triangles)
        for (const std::uint32_t index : t)
          if (index == kNone) return true;
      return false;
    };
    if (is_partial(mesh_.uv_triangles)) mesh_.uv.clear(), mesh_.uv_triangles.clear();
    if (is_partial(mesh_.normal_triangles)) mesh_.normals.clear(), mesh_.normal_triangles.clear();
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error("{}:{}: expected {}, found \"{}\" in \"{}\"", path_.string(), number_, expected, found,
                line_.substr(0, 60));
  }

  const std::filesystem::path& path_;
  const std::vector<Vec3>* shape_;
  TriangleMesh mesh_;
  MeshPart part_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> numbers_;
  std::string_view line_;
  int number_ = 0;
  std::vector<Corner> corners_;
  std::vector<Vec3> polygon_;
  std::vector<std::array<int, 3>> cut_;
};

}  // namespace

TriangleMesh read_obj(const std::filesystem::path& path, const std::vector<Vec3>* shape) {
  const std::string bytes = read_bytes(path);
  std::string_view text = bytes;
  if (text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE"))
    throw Error("{}: expected OBJ as ASCII or UTF-8 text, found UTF-16", path.string());
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return ObjReader(path, shape).read(text);
}

}  // namespace redmap
