// Atlases remembered on disk, one small file each: magic, counts, report, uv, uv triangles, checksum.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <optional>

#include "surface/atlas.h"
#include "surface/hash_bytes.h"
#include "surface/part_density.h"

namespace redmap {

namespace {

/// Raise the number at the end whenever unwrap() gives other uv for the same input.
constexpr std::uint64_t kMagic = 0x33534C5441'4D52;  // "RMATLS3"

struct Header {
  std::uint64_t magic = kMagic, key = 0, uv_count = 0, triangle_count = 0;
  double l2_stretch = 0, packing = 0;
  std::int64_t charts = 0, flips = 0;
};

std::uint64_t key_of(const TriangleMesh& mesh, const AtlasOptions& options) {
  std::uint64_t key = hash_bytes(hash_bytes(kMagic, mesh.positions), mesh.triangles);
  key = hash64(key, static_cast<std::uint64_t>(options.charts), static_cast<std::uint64_t>(options.resolution));
  key = hash64(key, static_cast<std::uint64_t>(options.cell_texels), static_cast<std::uint64_t>(options.gutter_texels));
  key = hash_bytes(key, &options.max_l2_stretch, sizeof options.max_l2_stretch);
  if (options.part_density.empty()) return key;
  return hash_bytes(key, triangle_densities(mesh, options.part_density));
}

std::string to_bytes(const Header& header, const TriangleMesh& mesh) {
  std::string bytes;
  const auto put = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  put(&header, sizeof header);
  put(mesh.uv.data(), mesh.uv.size() * sizeof(Vec2));
  put(mesh.uv_triangles.data(), mesh.uv_triangles.size() * sizeof(Triangle));
  const std::uint64_t checksum = hash_bytes(kMagic, bytes.data(), bytes.size());
  put(&checksum, sizeof checksum);
  return bytes;
}

/// Nothing for whatever is not exactly what to_bytes() wrote for this mesh.
std::optional<AtlasReport> from_bytes(const std::string& bytes, std::uint64_t key, TriangleMesh& mesh) {
  Header header;
  std::uint64_t checksum = 0;
  if (bytes.size() < sizeof header + sizeof checksum) return std::nullopt;
  const std::size_t body = bytes.size() - sizeof checksum;
  std::memcpy(&header, bytes.data(), sizeof header);
  std::memcpy(&checksum, bytes.data() + body, sizeof checksum);
  if (header.magic != kMagic || header.key != key || header.triangle_count != mesh.triangles.size() ||
      header.uv_count > body / sizeof(Vec2) ||
      body != sizeof header + header.uv_count * sizeof(Vec2) + header.triangle_count * sizeof(Triangle) ||
      checksum != hash_bytes(kMagic, bytes.data(), body))
    return std::nullopt;
  mesh.uv.resize(header.uv_count);
  mesh.uv_triangles.resize(header.triangle_count);
  const char* uv = bytes.data() + sizeof header;
  std::memcpy(mesh.uv.data(), uv, header.uv_count * sizeof(Vec2));
  std::memcpy(mesh.uv_triangles.data(), uv + header.uv_count * sizeof(Vec2), header.triangle_count * sizeof(Triangle));
  return AtlasReport{static_cast<int>(header.charts), header.l2_stretch, header.packing,
                     static_cast<int>(header.flips)};
}

void remember(const std::filesystem::path& path, const std::string& bytes) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const std::filesystem::path temporary = path.string() + ".tmp";
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) std::filesystem::rename(temporary, path, ignored);
  if (!out || ignored) std::filesystem::remove(temporary, ignored);
}

}  // namespace

AtlasReport unwrap_cached(TriangleMesh& mesh, const std::filesystem::path& cache_folder, const AtlasOptions& options) {
  const std::uint64_t key = key_of(mesh, options);
  const std::filesystem::path path = cache_folder / fmt::format("atlas-{:016x}.bin", key);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (const std::optional<AtlasReport> report = from_bytes(bytes, key, mesh)) return *report;
  const AtlasReport report = unwrap(mesh, options);
  const Header header{.key = key,
                      .uv_count = mesh.uv.size(),
                      .triangle_count = mesh.uv_triangles.size(),
                      .l2_stretch = report.l2_stretch,
                      .packing = report.packing,
                      .charts = report.charts,
                      .flips = report.flips};
  remember(path, to_bytes(header, mesh));
  return report;
}

}  // namespace redmap
