// Lookups whose footprint reaches over a seam of the atlas: render/seam_lookup.cpp, on the edges of surface/seams.h.
// They follow the clusters in the data (gpu/seam_memory.cpp): cells a side of a grid over uv; where the list of each cell
// starts, and the end; how many edges in all; the edges; the lists; the chart of each triangle.
#if REDMAP_LEAVES > 0
const uint redmap_seams_first = redmap_clusters_first + (2u * uint(REDMAP_LEAVES) - 1u) * redmap_cluster_floats;
#else
const uint redmap_seams_first = redmap_rest_first;
#endif
const uint redmap_edge_words = 13u;
uint redmap_grid_cells() { return redmap_word(redmap_seams_first); }
uint redmap_list_start(uint cell) { return redmap_word(redmap_seams_first + 1u + cell); }
uint redmap_edges_first() { return redmap_seams_first + 3u + redmap_grid_cells() * redmap_grid_cells(); }
uint redmap_lists_first() { return redmap_edges_first() + redmap_edge_words * redmap_word(redmap_edges_first() - 1u); }
uint redmap_chart(uint triangle) {
  uint cells = redmap_grid_cells();
  return redmap_word(redmap_lists_first() + redmap_list_start(cells * cells) + triangle);
}
vec2 redmap_pair(uint at) { return vec2(redmap_number(at), redmap_number(at + 1u)); }

const int redmap_pieces = redmap_seam_pieces * redmap_seam_pieces;
const float redmap_seam_slack = 1e-3;

struct RedmapFootprint {
  vec2 uv, dx, dy;
};
// From the centre to a piece's.
vec2 redmap_way(RedmapFootprint f, int i) {
  vec2 centre = vec2(float(i % redmap_seam_pieces) + 0.5, float(i / redmap_seam_pieces) + 0.5);
  centre = centre / float(redmap_seam_pieces) - 0.5;
  return f.dx * centre.x + f.dy * centre.y;
}

// The edge that the straight way to each piece crosses first, 0 for none; `near`: whether any edge is near at all.
struct RedmapCrossings {
  uint edge[redmap_pieces];
  float way[redmap_pieces];
  bool near;
};
void redmap_cross(uint edge, RedmapFootprint f, inout RedmapCrossings crossings) {
  vec2 from = redmap_pair(edge), along = redmap_pair(edge + 2u) - from, outward = redmap_pair(edge + 4u);
  for (int i = 0; i < redmap_pieces; i++) {
    vec2 change = redmap_way(f, i);
    float outwards = dot(change, outward), way = dot(from - f.uv, outward) / outwards;
    float part = dot(f.uv + change * way - from, along) / dot(along, along);
    if (outwards > 0.0 && way >= -redmap_seam_slack && way < crossings.way[i] && part >= -redmap_seam_slack &&
        part <= 1.0 + redmap_seam_slack) {
      crossings.way[i] = way;
      crossings.edge[i] = edge;
    }
  }
}
bool redmap_is_near(uint edge, uint chart, vec2 lower, vec2 upper) {
  vec2 from = redmap_pair(edge), to = redmap_pair(edge + 2u);
  return redmap_word(edge + 12u) == chart && all(lessThanEqual(min(from, to), upper)) &&
         all(greaterThanEqual(max(from, to), lower));
}
uvec2 redmap_cell(vec2 uv) {
  float cells = float(redmap_grid_cells());
  return uvec2(clamp(uv * cells, vec2(0.0), vec2(cells - 1.0)));
}
RedmapCrossings redmap_crossings(RedmapFootprint f, float reach, uint chart) {
  RedmapCrossings crossings;
  crossings.near = false;
  for (int i = 0; i < redmap_pieces; i++) {
    crossings.edge[i] = 0u;
    crossings.way[i] = 1.0;
  }
  vec2 lower = f.uv - reach, upper = f.uv + reach;
  uvec2 first = redmap_cell(lower), last = redmap_cell(upper);
  for (uint y = first.y; y <= last.y; y++) {
    // Cells of a row stand one after the other, and so do their lists.
    uint row = y * redmap_grid_cells(), end = redmap_list_start(row + last.x + 1u);
    for (uint i = redmap_list_start(row + first.x); i < end; i++) {
      redmap_forget_rounds();
      uint edge = redmap_edges_first() + redmap_edge_words * redmap_word(redmap_lists_first() + i);
      if (!redmap_is_near(edge, chart, lower, upper)) continue;
      crossings.near = true;
      redmap_cross(edge, f, crossings);
    }
  }
  return crossings;
}

// A piece, beyond the edge that is crossed on the way to it.
RedmapFootprint redmap_piece(RedmapFootprint f, int i, uint edge) {
  RedmapFootprint piece = RedmapFootprint(f.uv + redmap_way(f, i), f.dx / float(redmap_seam_pieces), f.dy / float(redmap_seam_pieces));
  if (edge == 0u) return piece;
  mat2 beyond = mat2(redmap_pair(edge + 8u), redmap_pair(edge + 10u));
  return RedmapFootprint(redmap_pair(edge + 6u) + beyond * (piece.uv - redmap_pair(edge)), beyond * piece.dx,
                         beyond * piece.dy);
}

// `texel`, what the footprint gave, or where it was not covered beside a seam, the mean of its pieces.
RedmapTexel redmap_mended(RedmapFootprint f, uint triangle, RedmapTexel texel) {
  float reach = 0.5 * (length(f.dx) + length(f.dy));
  if (redmap_coverage(texel) >= redmap_whole_coverage || reach * redmap_map.x < redmap_least_mended_reach) return texel;
  RedmapCrossings crossings = redmap_crossings(f, reach, redmap_chart(triangle));
  if (!crossings.near) return texel;
  // Texels come multiplied by coverage: their mean is weighted by it.
  RedmapTexel sum;
  for (int k = 0; k < redmap_layers; k++) sum.channels[k] = vec4(0.0);
  for (int i = 0; i < redmap_pieces; i++) {
    RedmapFootprint piece = redmap_piece(f, i, crossings.edge[i]);
    RedmapTexel one = redmap_taps(redmap_plan(piece.uv, redmap_axes(piece.dx, piece.dy)));
    for (int k = 0; k < redmap_layers; k++) sum.channels[k] += one.channels[k] / float(redmap_pieces);
  }
  // No ?: of structs: WebGL has none.
  if (redmap_coverage(sum) < redmap_least_coverage) return texel;
  return sum;
}

float[REDMAP_BASIS] redmap_look_up_over_seams(RedmapHit hit, RedmapAxes axes) {
  RedmapPlan plan = redmap_plan(hit.uv, axes);
  RedmapTexel texel = redmap_taps(plan);
#if REDMAP_LEAVES > 0
  // Where clusters serve alone there are no seams.
  if (redmap_cluster_part(axes) < 1.0)
#endif
    texel = redmap_mended(RedmapFootprint(hit.uv, hit.duv_dx, hit.duv_dy), hit.triangle, texel);
  return redmap_weights_of(hit.uv, plan.level, texel);
}
