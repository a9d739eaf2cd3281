// Stanford PLY: ascii and binary of both byte orders; polygons are cut into triangles; normals and uv where they are
// present.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "base/error.h"
#include "surface/mesh_files.h"
#include "surface/triangulate.h"

namespace redmap {

namespace {

enum class Format { ascii, little_endian, big_endian };

struct Scalar {
  std::size_t bytes = 0;
  bool is_float = false, is_signed = false;
};

std::optional<Scalar> scalar_of(std::string_view name) {
  if (name == "char" || name == "int8") return Scalar{1, false, true};
  if (name == "uchar" || name == "uint8") return Scalar{1, false, false};
  if (name == "short" || name == "int16") return Scalar{2, false, true};
  if (name == "ushort" || name == "uint16") return Scalar{2, false, false};
  if (name == "int" || name == "int32") return Scalar{4, false, true};
  if (name == "uint" || name == "uint32") return Scalar{4, false, false};
  if (name == "float" || name == "float32") return Scalar{4, true, true};
  if (name == "double" || name == "float64") return Scalar{8, true, true};
  return std::nullopt;
}

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> list_length;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

/// Walks through a PLY file; every failure names the file and the byte.
class PlyScanner {
 public:
  PlyScanner(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  void set_format(Format format) { format_ = format; }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) fail("a header ending in end_header", "the end of the file");
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  double value(Scalar type) { return format_ == Format::ascii ? ascii_value() : binary_value(type); }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error("{}: byte {}: expected {}, found {}", path_.string(), at_, expected, found);
  }

 private:
  double ascii_value() {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t start = bytes_.find_first_not_of(kBlanks, at_);
    if (start == std::string_view::npos) fail("a number", "the end of the file");
    const std::size_t end = std::min(bytes_.find_first_of(kBlanks, start), bytes_.size());
    double number = 0;
    const auto [stop, error] = std::from_chars(bytes_.data() + start, bytes_.data() + end, number);
    at_ = start;
    if (error != std::errc{} || stop != bytes_.data() + end)
      fail("a number", bytes_.substr(start, std::min<std::size_t>(end - start, 20)));
    at_ = end;
    return number;
  }

  double binary_value(Scalar type) {
    if (left() < type.bytes) fail(fmt::format("{} more bytes", type.bytes), "the end of the file");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t place = format_ == Format::big_endian ? i : type.bytes - 1 - i;
      bits = bits << 8 | static_cast<std::uint8_t>(bytes_[at_ + place]);
    }
    at_ += type.bytes;
    if (type.is_float)
      return type.bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits)) : std::bit_cast<double>(bits);
    // Shifting up and down again extends the sign.
    const int unused = static_cast<int>(64 - 8 * type.bytes);
    return type.is_signed ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                          : static_cast<double>(bits);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  Format format_ = Format::ascii;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty()) return words;
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

Format format_of(const PlyScanner& in, std::string_view name) {
  if (name == "ascii") return Format::ascii;
  if (name == "binary_little_endian") return Format::little_endian;
  if (name == "binary_big_endian") return Format::big_endian;
  in.fail("format ascii, binary_little_endian or binary_big_endian", name);
}

Property property_of(const PlyScanner& in, const std::vector<std::string_view>& words, std::string_view line) {
  const bool is_list = words.size() == 5 && words[1] == "list";
  if (!is_list && words.size() != 3) in.fail("property TYPE NAME or property list TYPE TYPE NAME", line);
  const std::optional<Scalar> type = scalar_of(words[is_list ? 3 : 1]);
  const std::optional<Scalar> length = is_list ? scalar_of(words[2]) : std::nullopt;
  if (!type || (is_list && (!length || length->is_float))) in.fail("a PLY scalar type", line);
  return {std::string(words.back()), *type, length};
}

Element element_of(const PlyScanner& in, const std::vector<std::string_view>& words, std::string_view line) {
  Element element;
  if (words.size() != 3) in.fail("element NAME COUNT", line);
  element.name = words[1];
  const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  if (error != std::errc{} || end != words[2].data() + words[2].size()) in.fail("element NAME COUNT", line);
  return element;
}

/// Lines that start with no keyword are passed over like comments: exporters have broken those in two.
std::vector<Element> read_header(PlyScanner& in) {
  if (in.line() != "ply") in.fail("a PLY file starting with \"ply\"", "something else");
  std::vector<Element> elements;
  bool has_format = false;
  while (true) {
    const std::string_view line = in.line();
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() > 1) {
      in.set_format(format_of(in, words[1]));
      has_format = true;
    } else if (words[0] == "element") {
      elements.push_back(element_of(in, words, line));
    } else if (words[0] == "property" && !elements.empty()) {
      elements.back().properties.push_back(property_of(in, words, line));
    } else if (words[0] == "property") {
      in.fail("an element before its properties", line);
    }
  }
  if (!has_format) in.fail("a format line", "none in the header");
  // Every record takes at least one byte a property in any format.
  for (const Element& element : elements)
    if (element.count > in.left() / std::max<std::size_t>(1, element.properties.size()))
      in.fail(fmt::format("{} records of \"{}\"", element.count, element.name), fmt::format("{} bytes", in.left()));
  return elements;
}

/// Where in a record of values the named property is; -1 where there is none.
int find_property(const Element& element, std::initializer_list<std::string_view> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    if (std::find(names.begin(), names.end(), element.properties[i].name) != names.end()) return static_cast<int>(i);
  return -1;
}

void read_vertices(PlyScanner& in, const Element& element, TriangleMesh& mesh) {
  const int x = find_property(element, {"x"}), y = find_property(element, {"y"}), z = find_property(element, {"z"});
  const int nx = find_property(element, {"nx"}), ny = find_property(element, {"ny"}),
            nz = find_property(element, {"nz"});
  const int u = find_property(element, {"u", "s", "texture_u"}), v = find_property(element, {"v", "t", "texture_v"});
  if (x < 0 || y < 0 || z < 0) in.fail("vertices with x, y and z", "a header without");
  std::vector<float> record(element.properties.size());
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < record.size(); ++k) {
      if (element.properties[k].list_length) in.fail("vertices without lists", element.properties[k].name);
      record[k] = static_cast<float>(in.value(element.properties[k].type));
    }
    mesh.positions.push_back({record[x], record[y], record[z]});
    if (nx >= 0 && ny >= 0 && nz >= 0) mesh.normals.push_back({record[nx], record[ny], record[nz]});
    if (u >= 0 && v >= 0) mesh.uv.push_back({record[u], record[v]});
  }
}

/// One property of one record: a single value, or a list.
void read_values(PlyScanner& in, const Property& property, std::vector<double>& values) {
  const double length = property.list_length ? in.value(*property.list_length) : 1;
  if (!(length >= 0 && length <= double(in.left())))
    in.fail("a list that fits the file", fmt::format("{} values", length));
  values.clear();
  for (double i = 0; i < length; ++i) values.push_back(in.value(property.type));
}

std::uint32_t index_of(const PlyScanner& in, double value) {
  if (!(value >= 0 && value < std::numeric_limits<std::uint32_t>::max()) || value != std::floor(value))
    in.fail("a vertex index", fmt::format("{}", value));
  return static_cast<std::uint32_t>(value);
}

/// Cuts the polygon into triangles; `first_uv`: where its own uv start, if it has any.
void add_polygon(std::span<const std::uint32_t> corners, const std::vector<Vec3>& shape,
                 std::optional<std::uint32_t> first_uv, TriangleMesh& mesh) {
  std::vector<Vec3> polygon;
  std::vector<std::array<int, 3>> cut;
  // Indices are checked by read_mesh(): until then, nowhere is as good as anywhere.
  for (const std::uint32_t corner : corners) polygon.push_back(corner < shape.size() ? shape[corner] : Vec3{});
  triangulate(polygon, cut);
  for (const auto& [a, b, c] : cut) {
    mesh.triangles.push_back({corners[a], corners[b], corners[c]});
    if (first_uv) mesh.uv_triangles.push_back({*first_uv + a, *first_uv + b, *first_uv + c});
  }
}

void read_faces(PlyScanner& in, const Element& element, const std::vector<Vec3>* shape, TriangleMesh& mesh) {
  const int corners_at = find_property(element, {"vertex_indices", "vertex_index"});
  const int uv_at = find_property(element, {"texcoord"});
  if (corners_at < 0) in.fail("faces with vertex_indices", "a header without");
  if (uv_at >= 0) mesh.uv.clear();
  std::vector<double> corners, uv, ignored;
  std::vector<std::uint32_t> polygon;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (int k = 0; k < static_cast<int>(element.properties.size()); ++k)
      read_values(in, element.properties[k], k == corners_at ? corners : k == uv_at ? uv : ignored);
    if (uv_at >= 0 && uv.size() != 2 * corners.size())
      in.fail(fmt::format("face {} with {} texture coordinates", i, 2 * corners.size()), fmt::format("{}", uv.size()));
    const auto first_uv = static_cast<std::uint32_t>(mesh.uv.size());
    if (uv_at >= 0)
      for (std::size_t k = 0; k < uv.size(); k += 2)
        mesh.uv.push_back({static_cast<float>(uv[k]), static_cast<float>(uv[k + 1])});
    polygon.clear();
    for (const double corner : corners) polygon.push_back(index_of(in, corner));
    add_polygon(polygon, shape ? *shape : mesh.positions, uv_at >= 0 ? std::optional(first_uv) : std::nullopt, mesh);
  }
}

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& path, const std::vector<Vec3>* shape) {
  const std::string bytes = read_bytes(path);
  PlyScanner in(path, bytes);
  TriangleMesh mesh;
  std::vector<double> ignored;
  for (const Element& element : read_header(in)) {
    if (element.name == "vertex") {
      read_vertices(in, element, mesh);
    } else if (element.name == "face") {
      read_faces(in, element, shape, mesh);
    } else {
      for (std::size_t i = 0; i < element.count; ++i)
        for (const Property& property : element.properties) read_values(in, property, ignored);
    }
  }
  if (!mesh.normals.empty()) mesh.normal_triangles = mesh.triangles;
  if (!mesh.uv.empty() && mesh.uv_triangles.empty()) mesh.uv_triangles = mesh.triangles;
  return mesh;
}

}  // namespace redmap
