// Charts of a given atlas, by union-find over the corners of its triangles.
#include "surface/charts.h"

#include <cstring>
#include <unordered_map>

#include "base/random.h"

namespace redmap {

namespace {

constexpr std::uint32_t kNobody = ~0u;

struct PositionAndUv {
  Vec3 position;
  Vec2 uv;
  friend bool operator==(const PositionAndUv&, const PositionAndUv&) = default;
};

struct HashPositionAndUv {
  std::size_t operator()(const PositionAndUv& key) const {
    std::uint32_t bits[5];
    // Adding zero makes -0 hash as 0, which it equals.
    const float floats[5] = {key.position.x + 0.0f, key.position.y + 0.0f, key.position.z + 0.0f, key.uv.x + 0.0f,
                             key.uv.y + 0.0f};
    std::memcpy(bits, floats, sizeof bits);
    return hash64(bits[0] | std::uint64_t{bits[1]} << 32, bits[2] | std::uint64_t{bits[3]} << 32, bits[4]);
  }
};

}  // namespace

std::vector<std::uint32_t> find_charts(const TriangleMesh& mesh) {
  std::unordered_map<PositionAndUv, std::uint32_t, HashPositionAndUv> corner_ids;
  std::vector<std::uint32_t> parent;
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<std::uint32_t> any_corner(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const PositionAndUv key{mesh.positions[mesh.triangles[t][k]], mesh.uv[mesh.uv_triangles[t][k]]};
      const auto [found, is_new] = corner_ids.try_emplace(key, static_cast<std::uint32_t>(parent.size()));
      if (is_new) parent.push_back(found->second);
      if (k == 0) any_corner[t] = found->second;
      parent[root(found->second)] = root(any_corner[t]);
    }
  std::vector<std::uint32_t> chart_of_root(parent.size(), kNobody), charts(mesh.triangles.size());
  std::uint32_t count = 0;
  for (std::size_t t = 0; t < charts.size(); ++t) {
    std::uint32_t& chart = chart_of_root[root(any_corner[t])];
    if (chart == kNobody) chart = count++;
    charts[t] = chart;
  }
  return charts;
}

}  // namespace redmap
