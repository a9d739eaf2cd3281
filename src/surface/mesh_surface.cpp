// A mesh with an atlas as a surface (paper, section 4.1): texels find their triangle by exact edge functions, hits
// bring theirs along.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "surface/charts.h"
#include "surface/hash_bytes.h"
#include "surface/mesh.h"
#include "surface/seams.h"
#include "surface/uv_edge.h"
#include "surface/uv_grid.h"

namespace redmap {

namespace {

constexpr std::uint32_t kNobody = ~0u;

/// (Sub-)points searched at a time: their owners stay in the second-level cache.
constexpr std::size_t kPointsPerBand = 1 << 16;

/// What one triangle needs at its texels and hits.
struct Face {
  Vec3 dp_du, dp_dv, dn_du, dn_dv, geometric_normal;
  std::uint32_t chart;
};

void check(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Error("mesh: expected at least one triangle, found none");
  if (mesh.uv_triangles.size() != mesh.triangles.size())
    throw Error("mesh: expected uv for all {} triangles, found {} (unwrap it first)", mesh.triangles.size(),
                mesh.uv_triangles.size());
  // Atlases written with few digits may end a hair outside.
  constexpr float kSlack = 1e-5f;
  for (std::size_t i = 0; i < mesh.uv.size(); ++i) {
    const Vec2 uv = mesh.uv[i];
    if (!(uv.x >= -kSlack && uv.x <= 1 + kSlack && uv.y >= -kSlack && uv.y <= 1 + kSlack))
      throw Error("mesh: expected uv in [0, 1], found ({}, {}) at uv {} (unwrap it to get an atlas)", uv.x, uv.y, i);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles[t][k] >= mesh.positions.size() || mesh.uv_triangles[t][k] >= mesh.uv.size() ||
          mesh.normal_triangles[t][k] >= mesh.normals.size())
        throw Error("mesh: triangle {} has an index beyond {} positions, {} uv, {} normals", t, mesh.positions.size(),
                    mesh.uv.size(), mesh.normals.size());
}

/// A point that was found: under which texel, which offset, on which triangle.
struct Found {
  std::uint32_t texel, offset, triangle;
};

class MeshSurface final : public Surface {
 public:
  explicit MeshSurface(TriangleMesh mesh) : mesh_(std::move(mesh)), grid_(mesh_.uv, mesh_.uv_triangles) {
    measure();
    build_faces();
    std::vector<std::uint32_t> charts;
    for (const Face& face : faces_) charts.push_back(face.chart);
    seams_.emplace(mesh_, charts);
  }

  Extent map_extent(int size) const override { return {size, size}; }
  bool wraps_u() const override { return false; }
  double area() const override { return area_; }
  double uv_area() const override { return uv_area_; }
  void rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets, std::span<const std::uint8_t> wanted,
                 TexelPoints& out) const override;
  std::uint32_t chart(std::uint32_t triangle) const override { return faces_[triangle].chart; }
  void complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const override;
  std::optional<AnalyticHit> intersect(Vec3, Vec3, float, float) const override { return std::nullopt; }
  const TriangleMesh* mesh() const override { return &mesh_; }
  const Seams* seams() const override { return &*seams_; }
  Vec3 lower() const override { return lower_; }
  Vec3 upper() const override { return upper_; }
  std::uint64_t fingerprint() const override { return fingerprint_; }

 private:
  void measure();
  void build_faces();
  void claim(Extent extent, TexelRegion band, std::span<const Vec2> offsets, std::vector<std::uint32_t>& owners) const;
  void set_point(std::size_t i, Extent extent, TexelPoint texels, std::uint32_t triangle, SurfacePoints& points) const;

  Vec3 position(std::size_t t, int k) const { return mesh_.positions[mesh_.triangles[t][k]]; }
  Vec3 normal(std::size_t t, int k) const { return mesh_.normals[mesh_.normal_triangles[t][k]]; }
  Vec2 uv(std::size_t t, int k) const { return mesh_.uv[mesh_.uv_triangles[t][k]]; }
  /// Exact: a float times a small whole number fits a double.
  TexelPoint texels(std::size_t t, int k, Extent extent) const {
    return {double(uv(t, k).x) * extent.width, double(uv(t, k).y) * extent.height};
  }

  TriangleMesh mesh_;
  UvGrid grid_;
  std::vector<Face> faces_;
  std::optional<Seams> seams_;
  double area_ = 0, uv_area_ = 0;
  Vec3 lower_, upper_;
  std::uint64_t fingerprint_ = 0;
};

void MeshSurface::measure() {
  lower_ = upper_ = position(0, 0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    area_ += 0.5 * length(cross(position(t, 1) - position(t, 0), position(t, 2) - position(t, 0)));
    uv_area_ += 0.5 * std::abs(cross(uv(t, 1) - uv(t, 0), uv(t, 2) - uv(t, 0)));
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        lower_[axis] = std::min(lower_[axis], position(t, k)[axis]);
        upper_[axis] = std::max(upper_[axis], position(t, k)[axis]);
      }
  }
  const auto add = [&](const auto& values) { fingerprint_ = hash_bytes(fingerprint_, values); };
  add(mesh_.positions), add(mesh_.triangles), add(mesh_.normals), add(mesh_.normal_triangles);
  add(mesh_.uv), add(mesh_.uv_triangles);
}

void MeshSurface::build_faces() {
  const std::vector<std::uint32_t> charts = find_charts(mesh_);
  // Where a triangle has no area in uv, its change with uv is a guess: the mesh's average, in any direction.
  const float average_scale = static_cast<float>(std::sqrt(area_ / std::max(uv_area_, 1e-12)));
  faces_.resize(mesh_.triangles.size());
  for (std::size_t t = 0; t < faces_.size(); ++t) {
    const Vec3 e1 = position(t, 1) - position(t, 0), e2 = position(t, 2) - position(t, 0);
    const Vec3 n1 = normal(t, 1) - normal(t, 0), n2 = normal(t, 2) - normal(t, 0);
    const Vec2 a = uv(t, 1) - uv(t, 0), b = uv(t, 2) - uv(t, 0);
    const double determinant = double(a.x) * b.y - double(a.y) * b.x;
    Face& face = faces_[t];
    face.geometric_normal = normalized(cross(e1, e2));
    face.chart = charts[t];
    const Frame frame = make_frame(face.geometric_normal, e1);
    face.dp_du = frame.x * average_scale, face.dp_dv = frame.y * average_scale;
    const float scale = static_cast<float>(1 / determinant);
    if (determinant == 0 || !std::isfinite(scale)) continue;
    face.dp_du = (e1 * b.y - e2 * a.y) * scale, face.dp_dv = (e2 * a.x - e1 * b.x) * scale;
    face.dn_du = (n1 * b.y - n2 * a.y) * scale, face.dn_dv = (n2 * a.x - n1 * b.x) * scale;
  }
}

void MeshSurface::claim(Extent extent, TexelRegion band, std::span<const Vec2> offsets,
                        std::vector<std::uint32_t>& owners) const {
  owners.assign(std::size_t(band.width) * band.height * offsets.size(), kNobody);
  // A hair more than the band: triangles are binned in floats.
  constexpr float kSlack = 1e-6f;
  const float w = static_cast<float>(extent.width), h = static_cast<float>(extent.height);
  std::vector<std::uint32_t> candidates;
  grid_.find({float(band.x) / w - kSlack, float(band.y) / h - kSlack},
             {float(band.x + band.width) / w + kSlack, float(band.y + band.height) / h + kSlack}, candidates);
  for (const std::uint32_t t : candidates) {
    const TexelPoint p[3] = {texels(t, 0, extent), texels(t, 1, extent), texels(t, 2, extent)};
    const UvEdge edges[3] = {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[0]}};
    const double orientation = edges[0].side(p[2]) < 0 ? -1 : 1;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [bottom, top] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const double ox = offsets[k].x, oy = offsets[k].y;
      const int x_begin = std::max(band.x, static_cast<int>(std::ceil(left - ox)));
      const int x_end = std::min(band.x + band.width - 1, static_cast<int>(std::floor(right - ox)));
      const int y_end = std::min(band.y + band.height - 1, static_cast<int>(std::floor(top - oy)));
      for (int y = std::max(band.y, static_cast<int>(std::ceil(bottom - oy))); y <= y_end; ++y) {
        const auto holds = [&](int x) {
          const TexelPoint at{x + ox, y + oy};
          return orientation * edges[0].side(at) >= 0 && orientation * edges[1].side(at) >= 0 &&
                 orientation * edges[2].side(at) >= 0;
        };
        // Along a row every side grows or falls, rounded or not: what lies between two points of the triangle is in it.
        int first = x_begin, last = x_end;
        while (first <= last && !holds(first)) ++first;
        if (first > last) continue;
        while (last > first && !holds(last)) --last;
        std::uint32_t* owner = &owners[(std::size_t(y - band.y) * band.width + (first - band.x)) * offsets.size() + k];
        for (int x = first; x <= last; ++x, owner += offsets.size())
          if (*owner == kNobody) *owner = t;
      }
    }
  }
}

void MeshSurface::set_point(std::size_t i, Extent extent, TexelPoint at, std::uint32_t t, SurfacePoints& points) const {
  const TexelPoint p0 = texels(t, 0, extent), p1 = texels(t, 1, extent), p2 = texels(t, 2, extent);
  const TexelPoint a{p1.x - p0.x, p1.y - p0.y}, b{p2.x - p0.x, p2.y - p0.y}, p{at.x - p0.x, at.y - p0.y};
  const double scale = 1 / (a.x * b.y - a.y * b.x);
  const float b1 = static_cast<float>((p.x * b.y - p.y * b.x) * scale);
  const float b2 = static_cast<float>((a.x * p.y - a.y * p.x) * scale);
  const float b0 = 1 - b1 - b2;
  const Frame frame =
      make_frame(normalized(normal(t, 0) * b0 + normal(t, 1) * b1 + normal(t, 2) * b2), faces_[t].dp_du);
  points.position.set(i, position(t, 0) * b0 + position(t, 1) * b1 + position(t, 2) * b2);
  points.normal.set(i, frame.z);
  points.tangent.set(i, frame.x);
  points.uv.set(i, Vec2{static_cast<float>(at.x / extent.width), static_cast<float>(at.y / extent.height)});
}

void MeshSurface::rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets,
                            std::span<const std::uint8_t> wanted, TexelPoints& out) const {
  std::vector<Found> found;
  std::vector<std::uint32_t> owners;
  const int band_rows = static_cast<int>(
      std::max<std::size_t>(1, kPointsPerBand / std::max<std::size_t>(1, std::size_t(region.width) * offsets.size())));
  for (int row = 0; row < region.height; row += band_rows) {
    const TexelRegion band{region.x, region.y + row, region.width, std::min(band_rows, region.height - row)};
    claim(extent, band, offsets, owners);
    const std::uint32_t first_texel = static_cast<std::uint32_t>(row * region.width);
    const std::uint32_t* owner = owners.data();
    for (std::uint32_t texel = first_texel; texel < first_texel + band.width * band.height; ++texel)
      for (std::uint32_t offset = 0; offset < offsets.size(); ++offset, ++owner)
        if (*owner != kNobody && (wanted.empty() || wanted[texel])) found.push_back({texel, offset, *owner});
  }

  out.texel.resize(found.size());
  out.points.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [texel, offset, triangle] = found[i];
    const int x = region.x + static_cast<int>(texel) % region.width,
              y = region.y + static_cast<int>(texel) / region.width;
    out.texel[i] = texel;
    set_point(i, extent, {x + double(offsets[offset].x), y + double(offsets[offset].y)}, triangle, out.points);
  }
}

void MeshSurface::complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::uint32_t t = hits[i].primitive;
    const float b1 = hits[i].coordinates.x, b2 = hits[i].coordinates.y, b0 = 1 - b1 - b2;
    const Face& face = faces_[t];
    const Vec3 blended = normal(t, 0) * b0 + normal(t, 1) * b1 + normal(t, 2) * b2;
    // Opposite normals may cancel: then the face's own stands in.
    const float blended_length = length(blended);
    const Vec3 unit = blended_length > 0 ? blended / blended_length : face.geometric_normal;
    const float unblend = blended_length > 0 ? 1 / blended_length : 0;
    const Vec3 place = position(t, 0) * b0 + position(t, 1) * b1 + position(t, 2) * b2;
    const Vec3 tangent = make_frame(unit, face.dp_du).x;
    out[i] = {.position = place,
              .normal = unit,
              .geometric_normal = face.geometric_normal,
              .tangent = tangent,
              .dp_du = face.dp_du,
              .dp_dv = face.dp_dv,
              .dn_du = (face.dn_du - unit * dot(unit, face.dn_du)) * unblend,
              .dn_dv = (face.dn_dv - unit * dot(unit, face.dn_dv)) * unblend,
              .uv = uv(t, 0) * b0 + uv(t, 1) * b1 + uv(t, 2) * b2,
              .chart = face.chart,
              .rest = {place, unit, tangent}};
  }
}

/// A mesh that is hit where it stands and shaded where it was at rest.
class PosedMeshSurface final : public Surface {
 public:
  PosedMeshSurface(TriangleMesh rest, TriangleMesh posed) : rest_(std::move(rest)), posed_(std::move(posed)) {}

  Extent map_extent(int size) const override { return rest_.map_extent(size); }
  bool wraps_u() const override { return false; }
  double area() const override { return rest_.area(); }
  double uv_area() const override { return rest_.uv_area(); }
  void rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets, std::span<const std::uint8_t> wanted,
                 TexelPoints& out) const override {
    rest_.rasterize(extent, region, offsets, wanted, out);
  }
  std::uint64_t fingerprint() const override { return rest_.fingerprint(); }

  void complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const override {
    posed_.complete(hits, out);
    std::vector<SurfaceHit> at_rest(hits.size());
    rest_.complete(hits, at_rest);
    for (std::size_t i = 0; i < hits.size(); ++i) out[i].rest = at_rest[i].rest, out[i].chart = at_rest[i].chart;
  }
  std::uint32_t chart(std::uint32_t triangle) const override { return rest_.chart(triangle); }
  std::optional<AnalyticHit> intersect(Vec3, Vec3, float, float) const override { return std::nullopt; }
  const TriangleMesh* mesh() const override { return posed_.mesh(); }
  const TriangleMesh* mesh_at_rest() const override { return rest_.mesh(); }
  const Seams* seams() const override { return rest_.seams(); }
  Vec3 lower() const override { return posed_.lower(); }
  Vec3 upper() const override { return posed_.upper(); }
  std::uint64_t pose_fingerprint() const override { return hash64(rest_.fingerprint(), posed_.fingerprint()); }

 private:
  MeshSurface rest_, posed_;
};

}  // namespace

std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh mesh) {
  if (mesh.normals.empty() || mesh.normal_triangles.size() != mesh.triangles.size()) compute_normals(mesh);
  check(mesh);
  return std::make_shared<MeshSurface>(std::move(mesh));
}

std::shared_ptr<const Surface> make_posed_surface(PosedMesh mesh) {
  if (mesh.posed.triangles != mesh.rest.triangles)
    throw Error("mesh: expected the same {} triangles at rest and posed, found others", mesh.rest.triangles.size());
  mesh.posed.uv = mesh.rest.uv, mesh.posed.uv_triangles = mesh.rest.uv_triangles;
  for (TriangleMesh* each : {&mesh.rest, &mesh.posed}) {
    if (each->normals.empty() || each->normal_triangles.size() != each->triangles.size()) compute_normals(*each);
    check(*each);
  }
  return std::make_shared<PosedMeshSurface>(std::move(mesh.rest), std::move(mesh.posed));
}

}  // namespace redmap
