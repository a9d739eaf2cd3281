// Integrals of basis reflectances that no lobe model fits: toon, off-specular, anisotropic. Normals are drawn from the
// mixtures, the same for every hit, and the reflectance is asked at each.
#include <array>
#include <cmath>
#include <numeric>

#include "lobes/gaussian_points.h"
#include "lobes/lobe_limits.h"
#include "render/basis_shading.h"

namespace redmap {

namespace {

static_assert(kDrawnNormals == kGatheredTurns, "each with a turn of the grain");

/// A point of distribution `k`, at `unit` of a Gaussian of variance 1.
Vec3 normal_at(const NormalMixtures& m, std::size_t k, Vec2 unit) {
  const float l11 = std::sqrt(m.xx[k]), l21 = l11 > 0 ? m.xy[k] / l11 : 0;
  const float l22 = std::sqrt(std::max(0.0f, m.yy[k] - l21 * l21));
  Vec2 xy{m.x[k] + l11 * unit.x, m.y[k] + l21 * unit.x + l22 * unit.y};
  if (const float r = length(xy); r > kSteepest) xy = xy * (kSteepest / r);
  return {xy.x, xy.y, std::sqrt(1 - dot(xy, xy))};
}

/// Which of the distributions [first, end) every drawn normal comes from: as many of each as its weight asks for,
/// spread over the points.
std::array<std::uint32_t, kDrawnNormals> owners_of(const LaneVector<float>& weights, std::uint32_t first,
                                                   std::uint32_t end, float total) {
  std::array<std::uint32_t, kDrawnNormals> owners;
  constexpr int kStride = 13;  // coprime to kDrawnNormals: neighbours on the spiral belong to different distributions
  std::uint32_t k = first;
  float sum = weights[first];
  for (int i = 0; i < kDrawnNormals; ++i) {
    const float wanted = total * (static_cast<float>(i) + 0.5f) / kDrawnNormals;
    while (sum < wanted && k + 1 < end) sum += weights[++k];
    owners[i * kStride % kDrawnNormals] = k;
  }
  return owners;
}

/// The x that drawn frame `n` of a hit leans to. Turns and normals are paired so that neither follows the other.
Vec3 tangent_of(const NormalMixtures& mixtures, std::uint32_t hit, int n) {
  if (mixtures.turns.empty()) return {1, 0, 0};
  constexpr int kStride = 11;  // coprime to kDrawnNormals, and another than that of the distributions
  const Vec2 turn = mixtures.turns[hit][n * kStride % kDrawnNormals];
  return {turn.x, turn.y, 0};
}

/// Whether one normal and one turn stand for all of a hit.
bool is_narrow(const NormalMixtures& m, std::uint32_t hit) {
  const std::uint32_t first = m.first[hit];
  if (m.turns.empty() || m.first[hit + 1] != first + 1) return false;
  const Vec2 a = m.turns[hit].front(), b = m.turns[hit].back();
  return std::abs(a.x * b.y - a.y * b.x) < kOneDrawnTurn &&
         m.xx[first] + m.yy[first] < kOneDrawnNormal * kOneDrawnNormal;
}

}  // namespace

void BasisShading::draw_normals(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                                std::size_t weights, std::span<const std::uint32_t> hits, Planes<3>& radiance,
                                RenderCounts& counts) const {
  if (hits.empty()) return;
  std::vector<int> draws(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) draws[i] = is_narrow(mixtures, hits[i]) ? 1 : kDrawnNormals;
  DirectionPairs drawn;
  drawn.resize(std::accumulate(draws.begin(), draws.end(), std::size_t{0}));
  std::vector<float> total(hits.size());
  std::size_t call = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::uint32_t hit = hits[i], first = mixtures.first[hit], end = mixtures.first[hit + 1];
    for (std::uint32_t k = first; k < end; ++k) total[i] += mixtures.weights[weights][k];
    const auto owners = owners_of(mixtures.weights[weights], first, end, total[i]);
    for (int n = 0; n < draws[i]; ++n, ++call) {
      const Vec3 normal =
          draws[i] == 1 ? normal_at(mixtures, first, {}) : normal_at(mixtures, owners[n], gaussian_points()[n]);
      const Frame frame = make_frame(normal, tangent_of(mixtures, hit, draws[i] == 1 ? kDrawnNormals / 2 : n));
      drawn.to_light.set(call, frame.to_local(pairs.to_light.get(hit)));
      drawn.to_viewer.set(call, frame.to_local(pairs.to_viewer.get(hit)));
    }
  }
  Planes<3> answers;
  patterns_->radiance_one(basis, drawn, answers);
  counts.shader_calls += drawn.size();
  call = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    Vec3 sum;
    for (int n = 0; n < draws[i]; ++n) sum += answers.get(call++);
    radiance.set(hits[i], sum * (total[i] / static_cast<float>(draws[i])));
  }
}

}  // namespace redmap
