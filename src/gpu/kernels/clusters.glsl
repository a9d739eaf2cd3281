// Far away the surface is looked up instead of its atlas: the tree of map/surface_clusters.cpp, a node at a time. It
// follows the drawn normals in the data, from its root on: position, normal, radius, variance, weights.
const uint redmap_clusters_first = redmap_rest_first;
const uint redmap_cluster_floats = 8u + uint(REDMAP_BASIS);

// The part that clusters have in a lookup.
float redmap_cluster_part(RedmapAxes axes) {
  float width = max(axes.minor, axes.major / redmap_lookup_anisotropy);
  return width > redmap_clusters_begin ? min(1.0, log2(width / redmap_clusters_begin)) : 0.0;
}

// How much of a place counts under a footprint: squared distances in units of its standard deviation, and the side.
struct RedmapKernel {
  vec3 centre, normal;
  mat3 inverse_variance;  // symmetric
  float largest_variance, smallest_variance;
};
RedmapKernel redmap_kernel(RedmapHit hit) {
  // Clusters face outwards, and are those of the surface at rest.
  vec3 position = hit.position, outward = hit.turned ? -hit.normal : hit.normal;
  vec3 x = hit.dp_du * hit.duv_dx.x + hit.dp_dv * hit.duv_dx.y, y = hit.dp_du * hit.duv_dy.x + hit.dp_dv * hit.duv_dy.y;
#ifdef REDMAP_POSED
  position = hit.rest_position;
  outward = hit.turned ? -hit.rest_normal : hit.rest_normal;
#endif
  x = redmap_at_rest(hit, x);
  y = redmap_at_rest(hit, y);
  float xx = dot(x, x), yy = dot(y, y), longer = max(xx, yy), area = length(cross(x, y));
  mat3 variance = (outerProduct(x, x) + outerProduct(y, y) + longer * outerProduct(outward, outward) +
                   mat3(redmap_cluster_round * longer)) * (1.0 / 12.0);
  // Its inverse by hand: that of the language need not be exact.
  vec3 a = cross(variance[1], variance[2]), b = cross(variance[2], variance[0]), c = cross(variance[0], variance[1]);
  float determinant = dot(variance[0], a);
  float smallest = longer > 0.0 ? max(area * area / longer, redmap_cluster_round * longer) / 12.0 : 0.0;
  return RedmapKernel(position, outward, mat3(a / determinant, b / determinant, c / determinant),
                      (longer + xx + yy) / 12.0, smallest);
}

struct RedmapCluster {
  vec3 away, normal;  // from the centre of the footprint
  float radius, variance;
};
RedmapCluster redmap_cluster(uint node, vec3 centre) {
  uint at = redmap_clusters_first + (node - 1u) * redmap_cluster_floats;
  return RedmapCluster(redmap_vector(at) - centre, redmap_vector(at + 3u), redmap_number(at + 6u),
                       redmap_number(at + 7u));
}
bool redmap_reaches(RedmapKernel kernel, RedmapCluster cluster) {
  float reach = sqrt(redmap_cluster_support * kernel.largest_variance) + cluster.radius;
  return dot(cluster.away, cluster.away) < reach * reach;
}
bool redmap_is_small(RedmapKernel kernel, RedmapCluster cluster) {
  return cluster.variance < 0.1 * kernel.smallest_variance && dot(cluster.normal, cluster.normal) > 0.9;
}
float redmap_weight_under(RedmapKernel kernel, RedmapCluster cluster) {
  float near = max(0.0, 1.0 - dot(cluster.away, kernel.inverse_variance * cluster.away) / redmap_cluster_support);
  return near * clamp(redmap_cluster_side_slope * dot(kernel.normal, cluster.normal), 0.0, 1.0);
}

// Mixes the mean of what is under the footprint and faces its side into weights from the atlas.
void redmap_blend_clusters(RedmapHit hit, RedmapAxes axes, inout float weights[REDMAP_BASIS]) {
  float part = redmap_cluster_part(axes);
  if (part <= 0.0) return;
  RedmapKernel kernel = redmap_kernel(hit);
  float sums[REDMAP_BASIS], total = 0.0;
  for (int b = 0; b < REDMAP_BASIS; b++) sums[b] = 0.0;
  // Down to the left child, or on to whatever is to the right: past the last node that is the root again.
  uint node = 1u;
  do {
    redmap_forget_rounds();
    RedmapCluster cluster = redmap_cluster(node, kernel.centre);
    bool reaches = redmap_reaches(kernel, cluster);
    if (reaches && node < uint(REDMAP_LEAVES) && !redmap_is_small(kernel, cluster)) {
      node *= 2u;
      continue;
    }
    // Patches on one level have equal areas: twice that of the level below.
    float share = reaches ? redmap_weight_under(kernel, cluster) * exp2(-float(findMSB(node))) : 0.0;
    if (share > 0.0) {
      uint mean = redmap_clusters_first + (node - 1u) * redmap_cluster_floats + 8u;
      for (uint b = 0u; b < uint(REDMAP_BASIS); b++) sums[b] += share * redmap_number(mean + b);
      total += share;
    }
    node++;
    node >>= findLSB(node);
  } while (node > 1u);
  if (total > 0.0)
    for (int b = 0; b < REDMAP_BASIS; b++) weights[b] = mix(weights[b], sums[b] / total, part);
}
