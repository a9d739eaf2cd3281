// How the surface goes on where a chart of its atlas ends: every seam has another side, elsewhere in uv. After the
// indirection of Ray et al. 2010, "Invisible Seams", here as one affine change of uv an edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh.h"
#include "surface/uv_grid.h"

namespace redmap {

/// The way over an edge of a chart into another chart, or into a far part of the same. All in uv.
struct SeamEdge {
  Vec2 from, to;
  Vec2 outward;           ///< unit, away from the chart
  Vec2 from_beyond;       ///< `from` on the other side
  Vec2 along_u, along_v;  ///< change of uv beyond with u and with v, were the chart continued
  std::uint32_t chart = 0;

  Vec2 beyond(Vec2 uv) const { return from_beyond + direction_beyond(uv - from); }
  Vec2 direction_beyond(Vec2 change) const { return along_u * change.x + along_v * change.y; }
};

class Seams {
 public:
  /// `charts`: of each triangle of `mesh`, as find_charts() gives them. Edges of the surface itself, edges of more than
  /// two triangles, and edges between triangles without a shape in uv lead nowhere.
  Seams(const TriangleMesh& mesh, std::span<const std::uint32_t> charts);

  bool empty() const { return edges_.empty(); }
  std::span<const SeamEdge> edges() const { return edges_; }

  /// The edges of `chart` that may come within `reach` of `uv` in u and in v.
  std::vector<SeamEdge> near(Vec2 uv, std::uint32_t chart, float reach) const;

 private:
  void add(const TriangleMesh& mesh, std::span<const std::uint32_t> charts, std::uint32_t triangle, int k,
           std::uint32_t other, int l);

  std::vector<SeamEdge> edges_;
  UvGrid grid_;  ///< of the triangles that the edges belong to, one for each edge
};

/// The first of `edges` that one crosses going straight from `uv`, inside their chart, to `uv + change`; null if none.
const SeamEdge* first_crossed(std::span<const SeamEdge> edges, Vec2 uv, Vec2 change);

}  // namespace redmap
