// The map over an edge keeps the edge, and turns a step out of the one triangle into a step into the other.
#include "surface/seams.h"

#include <algorithm>
#include <cmath>

#include "surface/face_graph.h"

namespace redmap {

namespace {

/// Change of uv along an edge, and with a step of unit length on the surface from the edge into the triangle.
struct EdgeAxes {
  Vec2 along, inward;
  bool has_shape = false;
};

/// `from`, `to` and `apex` are corners of one triangle.
EdgeAxes edge_axes(const TriangleMesh& mesh, std::uint32_t triangle, int from, int to, int apex) {
  // Thinner triangles say little about what is across their edges.
  constexpr float kThin = 0.01f;
  const auto position = [&](int k) { return mesh.positions[mesh.triangles[triangle][k]]; };
  const auto uv = [&](int k) { return mesh.uv[mesh.uv_triangles[triangle][k]]; };
  const Vec3 edge = position(to) - position(from), side = position(apex) - position(from);
  const float squared = dot(edge, edge);
  if (!(squared > 0)) return {};
  const float part = dot(edge, side) / squared, height = length(side - edge * part);
  const Vec2 along = uv(to) - uv(from);
  const Vec2 inward = (uv(apex) - uv(from) - along * part) * (1 / std::max(height, kThin * std::sqrt(squared)));
  return {along, inward, height > kThin * std::sqrt(squared) && std::isnormal(cross(along, inward))};
}

/// The edge from corner l to corner l + 1 of `other` that runs against that from corner k of `triangle`; -1 if none.
int opposite_edge(const TriangleMesh& mesh, std::uint32_t triangle, int k, std::uint32_t other) {
  const auto position = [&](std::uint32_t t, int corner) { return mesh.positions[mesh.triangles[t][corner % 3]]; };
  for (int l = 0; l < 3; ++l)
    if (position(other, l) == position(triangle, k + 1) && position(other, l + 1) == position(triangle, k)) return l;
  return -1;
}

/// One triangle an edge.
std::vector<Triangle> triangles_of_edges(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<Triangle> result;
  for (const std::uint32_t t : triangles) result.push_back(mesh.uv_triangles[t]);
  return result;
}

}  // namespace

Seams::Seams(const TriangleMesh& mesh, std::span<const std::uint32_t> charts) : grid_({}, {}) {
  const FaceGraph graph = make_face_graph(mesh);
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (graph.neighbours[t][k] < 0) continue;
      const auto other = static_cast<std::uint32_t>(graph.neighbours[t][k]);
      const int l = opposite_edge(mesh, t, k, other);
      if (l < 0) continue;
      const std::size_t before = edges_.size();
      add(mesh, charts, t, k, other, l);
      if (edges_.size() > before) triangles.push_back(t);
    }
  grid_ = UvGrid(mesh.uv, triangles_of_edges(mesh, triangles));
}

void Seams::add(const TriangleMesh& mesh, std::span<const std::uint32_t> charts, std::uint32_t t, int k,
                std::uint32_t other, int l) {
  const auto uv = [&](std::uint32_t triangle, int corner) { return mesh.uv[mesh.uv_triangles[triangle][corner % 3]]; };
  const Vec2 from = uv(t, k), to = uv(t, k + 1), from_beyond = uv(other, l + 1), to_beyond = uv(other, l);
  if (from == from_beyond && to == to_beyond) return;
  const EdgeAxes here = edge_axes(mesh, t, k, (k + 1) % 3, (k + 2) % 3);
  const EdgeAxes there = edge_axes(mesh, other, (l + 1) % 3, l, (l + 2) % 3);
  if (!here.has_shape || !there.has_shape) return;
  // Columns of the inverse of [along, -inward], times [along, inward] of the other side.
  const Vec2 step_out = here.inward * -1;
  const float scale = 1 / cross(here.along, step_out);
  const Vec2 along_u = there.along * (step_out.y * scale) + there.inward * (-here.along.y * scale);
  const Vec2 along_v = there.along * (-step_out.x * scale) + there.inward * (here.along.x * scale);
  const Vec2 normal = Vec2{here.along.y, -here.along.x} * (1 / length(here.along));
  const Vec2 outward = dot(normal, step_out) < 0 ? normal * -1 : normal;
  edges_.push_back({from, to, outward, from_beyond, along_u, along_v, charts[t]});
}

std::vector<SeamEdge> Seams::near(Vec2 uv, std::uint32_t chart, float reach) const {
  const Vec2 lower = uv - Vec2{reach, reach}, upper = uv + Vec2{reach, reach};
  std::vector<std::uint32_t> candidates;
  grid_.find(lower, upper, candidates);
  std::vector<SeamEdge> near;
  for (const std::uint32_t i : candidates) {
    const SeamEdge& edge = edges_[i];
    const auto [left, right] = std::minmax(edge.from.x, edge.to.x);
    const auto [bottom, top] = std::minmax(edge.from.y, edge.to.y);
    if (edge.chart == chart && left <= upper.x && right >= lower.x && bottom <= upper.y && top >= lower.y)
      near.push_back(edge);
  }
  return near;
}

const SeamEdge* first_crossed(std::span<const SeamEdge> edges, Vec2 uv, Vec2 change) {
  // Rounding must leave no gap between two edges, nor lose a start on an edge itself.
  constexpr float kSlack = 1e-3f;
  const SeamEdge* first = nullptr;
  float nearest = 1;
  for (const SeamEdge& edge : edges) {
    const float out = dot(change, edge.outward);
    if (!(out > 0)) continue;
    const float way = dot(edge.from - uv, edge.outward) / out;
    if (!(way >= -kSlack && way < nearest)) continue;
    const Vec2 along = edge.to - edge.from, hit = uv + change * way - edge.from;
    const float part = dot(hit, along) / dot(along, along);
    if (part < -kSlack || part > 1 + kSlack) continue;
    nearest = way, first = &edge;
  }
  return first;
}

}  // namespace redmap
