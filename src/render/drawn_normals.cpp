// Integrals of basis reflectances that no lobe model fits: toon, off-specular, anisotropic. Normals are drawn from the
// mixtures, the same for every hit, and the reflectance is asked at each.
#include <array>
#include <cmath>

#include "lobes/gaussian_points.h"
#include "render/basis_shading.h"

namespace redmap {

namespace {

/// A point of distribution `k`, at `unit` of a Gaussian of variance 1.
Vec3 normal_at(const NormalMixtures& m, std::size_t k, Vec2 unit) {
  const float l11 = std::sqrt(m.xx[k]), l21 = l11 > 0 ? m.xy[k] / l11 : 0;
  const float l22 = std::sqrt(std::max(0.0f, m.yy[k] - l21 * l21));
  Vec2 xy{m.x[k] + l11 * unit.x, m.y[k] + l21 * unit.x + l22 * unit.y};
  constexpr float kSteepest = 0.98f;
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

}  // namespace

void BasisShading::draw_normals(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                                std::size_t weights, std::span<const std::uint32_t> hits, Planes<3>& radiance,
                                RenderCounts& counts) const {
  if (hits.empty()) return;
  DirectionPairs drawn;
  drawn.resize(hits.size() * kDrawnNormals);
  std::vector<float> total(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::uint32_t first = mixtures.first[hits[i]], end = mixtures.first[hits[i] + 1];
    for (std::uint32_t k = first; k < end; ++k) total[i] += mixtures.weights[weights][k];
    const auto owners = owners_of(mixtures.weights[weights], first, end, total[i]);
    for (int n = 0; n < kDrawnNormals; ++n) {
      const Frame frame = make_frame(normal_at(mixtures, owners[n], gaussian_points()[n]), {1, 0, 0});
      drawn.to_light.set(i * kDrawnNormals + n, frame.to_local(pairs.to_light.get(hits[i])));
      drawn.to_viewer.set(i * kDrawnNormals + n, frame.to_local(pairs.to_viewer.get(hits[i])));
    }
  }
  Planes<3> answers;
  patterns_->radiance_one(basis, drawn, answers);
  counts.shader_calls += drawn.size();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    Vec3 sum;
    for (int n = 0; n < kDrawnNormals; ++n) sum += answers.get(i * kDrawnNormals + n);
    radiance.set(hits[i], sum * (total[i] / kDrawnNormals));
  }
}

}  // namespace redmap
