// STL, binary and ASCII: facets with corners of their own, here shared where they are equal. The facets' normals are
// computed, since those of files are often zero; the solids of an ASCII file are its parts.
#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <map>
#include <string_view>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of anything, and the number of facets
constexpr std::size_t kFacetBytes = 50;   // a normal, three corners, two bytes of anything
static_assert(std::endian::native == std::endian::little, "STL is little-endian");

class StlMesh {
 public:
  void start_part(std::string_view name) { mesh_.parts.push_back({std::string(name), ""}); }

  void add_facet(const std::array<Vec3, 3>& corners) {
    const Triangle triangle{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])};
    const auto normal = static_cast<std::uint32_t>(mesh_.normals.size());
    mesh_.normals.push_back(normalized(cross(corners[1] - corners[0], corners[2] - corners[0])));
    mesh_.triangles.push_back(triangle);
    mesh_.normal_triangles.push_back({normal, normal, normal});
    mesh_.triangle_parts.push_back(static_cast<std::uint32_t>(mesh_.parts.size() - 1));
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(Vec3 p) {
    // -0 is 0; whatever is not finite stays by itself and is found by read_mesh().
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };
    const auto [found, is_new] = vertices_.try_emplace(std::array{bits(p.x), bits(p.y), bits(p.z)},
                                                       static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    return found->second;
  }

  TriangleMesh mesh_;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> vertices_;
};

TriangleMesh read_binary(const std::filesystem::path& path, std::string_view bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() < kHeaderBytes)
    throw Error("{}: expected an STL file of at least {} bytes, found {}", path.string(), kHeaderBytes, bytes.size());
  std::memcpy(&facets, bytes.data() + kHeaderBytes - sizeof facets, sizeof facets);
  if ((bytes.size() - kHeaderBytes) / kFacetBytes < facets)
    throw Error("{}: expected {} facets of {} bytes, found {} bytes", path.string(), facets, kFacetBytes,
                bytes.size() - kHeaderBytes);
  StlMesh mesh;
  mesh.start_part("");
  for (std::size_t i = 0; i < facets; ++i) {
    std::array<Vec3, 3> corners;
    std::memcpy(corners.data(), bytes.data() + kHeaderBytes + i * kFacetBytes + sizeof(Vec3), sizeof corners);
    mesh.add_facet(corners);
  }
  return mesh.take();
}

/// Reads ASCII STL word by word; keywords in any case.
class AsciiReader {
 public:
  AsciiReader(const std::filesystem::path& path, std::string_view text) : path_(path), left_(text) {}

  TriangleMesh read() {
    StlMesh mesh;
    while (!at_end()) {
      expect("solid");
      mesh.start_part(rest_of_line());
      std::string next = word();
      for (; next == "facet"; next = word()) mesh.add_facet(facet());
      if (next != "endsolid") fail("facet or endsolid", next);
      rest_of_line();
    }
    return mesh.take();
  }

 private:
  std::array<Vec3, 3> facet() {
    expect("normal");
    // Often zero, or nan for facets without area: never used.
    for (int i = 0; i < 3; ++i) word();
    expect("outer"), expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("vertex");
      corner = {number(), number(), number()};
    }
    expect("endloop"), expect("endfacet");
    return corners;
  }

  bool at_end() {
    skip_blanks();
    return left_.empty();
  }

  void skip_blanks() {
    while (!left_.empty() && std::isspace(static_cast<unsigned char>(left_[0]))) {
      line_ += left_[0] == '\n';
      left_.remove_prefix(1);
    }
  }

  std::string word() {
    skip_blanks();
    const std::size_t end = std::min(left_.find_first_of(" \t\r\n"), left_.size());
    std::string result(left_.substr(0, end));
    left_.remove_prefix(end);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
  }

  std::string_view rest_of_line() {
    const std::string_view line = left_.substr(0, left_.find_first_of("\r\n"));
    left_.remove_prefix(line.size());
    const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
    return line.substr(start, line.find_last_not_of(" \t") + 1 - start);
  }

  float number() {
    const std::string text = word();
    const std::string_view digits = std::string_view(text).substr(text.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) fail("a number", text);
    return static_cast<float>(value);
  }

  void expect(std::string_view keyword) {
    const std::string found = word();
    if (found != keyword) fail(keyword, found);
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error("{}:{}: expected {}, found {}", path_.string(), line_, expected,
                found.empty() ? "the end of the file" : fmt::format("\"{}\"", found.substr(0, 20)));
  }

  const std::filesystem::path& path_;
  std::string_view left_;
  int line_ = 1;
};

/// Binary files may start with "solid" too: then their size is the one that their number of facets asks for.
bool is_ascii(std::string_view bytes) {
  if (!bytes.starts_with("solid") && !bytes.starts_with("SOLID")) return false;
  std::uint32_t facets = 0;
  if (bytes.size() >= kHeaderBytes) std::memcpy(&facets, bytes.data() + kHeaderBytes - sizeof facets, sizeof facets);
  return bytes.size() != kHeaderBytes + std::size_t(facets) * kFacetBytes;
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  return is_ascii(bytes) ? AsciiReader(path, bytes).read() : read_binary(path, bytes);
}

}  // namespace redmap
