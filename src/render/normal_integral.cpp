// Integrals of a basis reflectance over the normals under a footprint, the cheapest sufficient way for each hit: one
// normal, the lobe model in closed form corrected by one call, or drawn normals (docs/normals.md).
#include <algorithm>
#include <cmath>

#include "base/lanes_math.h"
#include "render/basis_shading.h"

namespace redmap {

namespace {

using lanes::Float;

bool any(lanes::Bool b) {
  for (std::size_t i = 0; i < kLanes; ++i)
    if (b.v[i]) return true;
  return false;
}
Vec3Lanes load(const Planes<3>& planes, std::size_t i) {
  return {lanes::load(planes[0] + i), lanes::load(planes[1] + i), lanes::load(planes[2] + i)};
}

NormalLanes load_normals(const NormalMixtures& m, std::size_t i) {
  return {lanes::load(&m.x[i]), lanes::load(&m.y[i]), lanes::load(&m.xx[i]), lanes::load(&m.xy[i]),
          lanes::load(&m.yy[i])};
}

/// Distributions [i, i + kLanes) with their weights; those from `end` on weigh nothing.
struct WeightedNormals {
  NormalLanes normals;
  Float weight;
};
WeightedNormals load_some(const NormalMixtures& m, std::size_t weights, std::size_t i, std::size_t end) {
  if (i + kLanes <= end) return {load_normals(m, i), lanes::load(&m.weights[weights][i])};
  WeightedNormals some{{0.0f, 0.0f, 0.0f, 0.0f, 0.0f}, 0.0f};
  for (std::size_t k = i; k < end; ++k) {
    const std::size_t lane = k - i;
    some.normals.x.v[lane] = m.x[k], some.normals.y.v[lane] = m.y[k];
    some.normals.xx.v[lane] = m.xx[k], some.normals.xy.v[lane] = m.xy[k], some.normals.yy.v[lane] = m.yy[k];
    some.weight.v[lane] = m.weights[weights][k];
  }
  return some;
}

/// Adds up what eight distributions of one hit gave, into lane `lane` of the sums of eight hits.
void reduce(const LobeSums& of_hit, std::size_t lane, LobeSums& hits) {
  for (int k = 0; k < LobeModel::kWidths; ++k) hits.gaussian[k].v[lane] = lanes::sum(of_hit.gaussian[k]);
  const auto each = [&](Float LobeSums::*member) { (hits.*member).v[lane] = lanes::sum(of_hit.*member); };
  for (Float LobeSums::*member : {&LobeSums::cosine, &LobeSums::in_plane, &LobeSums::across, &LobeSums::brightness,
                                  &LobeSums::spread, &LobeSums::weight, &LobeSums::x, &LobeSums::y})
    each(member);
}

/// Directions in the frame of `normal`, its x along the x that they are given in.
struct PairLanes {
  Vec3Lanes to_light, to_viewer;
};
PairLanes in_frame_of(const Vec3Lanes& normal, const PairLanes& pair) {
  const Float along = lanes::sqrt(lanes::max(1.0f - normal.x * normal.x, 1e-12f));
  const Vec3Lanes x{along, -normal.x * normal.y / along, -normal.x * normal.z / along};
  const Vec3Lanes y{0.0f, normal.z / along, -normal.y / along};
  const auto local = [&](const Vec3Lanes& v) -> Vec3Lanes {
    return {v.x * x.x + v.y * x.y + v.z * x.z, v.y * y.y + v.z * y.z, v.x * normal.x + v.y * normal.y + v.z * normal.z};
  };
  return {local(pair.to_light), local(pair.to_viewer)};
}

/// Calls that one basis reflectance has to answer: some hits, each at a normal of its own.
class Calls {
 public:
  /// Of the first `count` hits from `hit` on, those that are `wanted`.
  void add(std::size_t hit, std::size_t count, lanes::Bool wanted, const Vec3Lanes& normal, const PairLanes& pair) {
    const std::size_t before = hits_.size();
    for (std::size_t lane = 0; lane < count; ++lane)
      if (wanted.v[lane]) hits_.push_back(static_cast<std::uint32_t>(hit + lane));
    if (hits_.size() == before) return;
    const PairLanes local = in_frame_of(normal, pair);
    const Vec3Lanes &l = local.to_light, &v = local.to_viewer;
    for (std::size_t call = before; call < hits_.size(); ++call) {
      const std::size_t lane = hits_[call] - hit;
      directions_.push_back({l.x.v[lane], l.y.v[lane], l.z.v[lane]});
      directions_.push_back({v.x.v[lane], v.y.v[lane], v.z.v[lane]});
    }
  }
  std::size_t size() const { return hits_.size(); }
  std::uint32_t hit(std::size_t call) const { return hits_[call]; }
  /// The answers, one a call.
  void answer(const BoundPatterns& patterns, std::size_t pattern, Planes<3>& radiance) const {
    DirectionPairs pairs;
    pairs.resize(size());
    for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
      const std::size_t from = 2 * std::min(i, size() - 1);
      pairs.to_light.set(i, directions_[from]), pairs.to_viewer.set(i, directions_[from + 1]);
    }
    patterns.radiance_one(pattern, pairs, radiance);
  }

 private:
  std::vector<std::uint32_t> hits_;
  std::vector<Vec3> directions_;  ///< to light and to viewer of each
};

/// What the model says of eight hits, and at which normals the reflectance itself is to be asked.
struct Modelled {
  Float weight;
  LobeValue whole, at_mean, at_brightest;
  Vec3Lanes mean, brightest;
  Float part;  ///< of the integral calibrated at the brightest normal, against that corrected at the mean
};

LobeSums sums_of(const NormalMixtures& mixtures, std::size_t weights, const WidthsInUse& in_use, const LobeLanes& lobes,
                 const HalfVectorLanes& half, std::span<const std::uint8_t> lit, std::size_t hit, std::size_t hits) {
  LobeSums sums;
  if (mixtures.one_a_hit) {
    add_distribution(in_use, lobes, half, load_normals(mixtures, hit), lanes::load(&mixtures.weights[weights][hit]),
                     sums);
    return sums;
  }
  for (std::size_t lane = 0; lane < std::min(kLanes, hits - hit); ++lane) {
    if (!lit.empty() && !lit[hit + lane]) continue;
    LobeSums of_hit;
    const LobeLanes own_lobes = broadcast(lobes, in_use, lane);
    const HalfVectorLanes own_half = broadcast(half, lane);
    const std::uint32_t end = mixtures.first[hit + lane + 1];
    for (std::size_t i = mixtures.first[hit + lane]; i < end; i += kLanes) {
      const WeightedNormals some = load_some(mixtures, weights, i, end);
      add_distribution(in_use, own_lobes, own_half, some.normals, some.weight, of_hit);
    }
    reduce(of_hit, lane, sums);
  }
  return sums;
}

Modelled model_hits(const LobeModel& model, const WidthsInUse& in_use, const NormalMixtures& mixtures,
                    std::size_t weights, const PairLanes& pair, std::span<const std::uint8_t> lit, std::size_t hit,
                    std::size_t hits) {
  const HalfVectorLanes half = half_vector(pair.to_light, pair.to_viewer);
  const LobeLanes lobes = lobes_at(model, in_use, half.theta_degrees);
  Modelled m;
  const LobeSums sums = sums_of(mixtures, weights, in_use, lobes, half, lit, hit, hits);
  m.weight = sums.weight;
  m.whole = integral(in_use, lobes, sums);
  const Float inverse = 1.0f / lanes::max(sums.weight, 1e-12f), x = sums.x * inverse, y = sums.y * inverse;
  m.mean = {x, y, lanes::sqrt(lanes::max(1.0f - x * x - y * y, 0.01f))};
  m.at_mean = at_normal(in_use, lobes, half, m.mean);
  m.part = calibrated_part(sums, m.whole, m.at_mean);
  m.brightest = m.mean, m.at_brightest = m.at_mean;
  if (any(m.part > 0.0f)) {
    m.brightest = brightest_normal(half, sums);
    m.at_brightest = at_normal(in_use, lobes, half, m.brightest);
  }
  return m;
}

bool has_weight(const NormalMixtures& m, std::size_t weights, std::size_t hit) {
  const auto begin = m.weights[weights].begin();
  return std::any_of(begin + m.first[hit], begin + m.first[hit + 1], [](float weight) { return weight > 0; });
}

ColourLanes load_colour(const Planes<3>& planes, std::size_t i) {
  return {lanes::load(planes[0] + i), lanes::load(planes[1] + i), lanes::load(planes[2] + i)};
}

/// The answers of `calls` where their hits are.
void scatter(const Calls& calls, const BoundPatterns& patterns, std::size_t pattern, Planes<3>& by_hit) {
  if (calls.size() == 0) return;
  Planes<3> answers;
  calls.answer(patterns, pattern, answers);
  for (std::size_t i = 0; i < calls.size(); ++i) by_hit.set(calls.hit(i), answers.get(i));
}

}  // namespace

void BasisShading::integrate_basis(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                                   std::size_t weights, std::span<const std::uint8_t> lit, const Planes<3>* given,
                                   Planes<3>& radiance, std::span<Decision> decisions, RenderCounts& counts) const {
  const Lobes& lobes = lobes_[basis];
  if (!lobes.trusted) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < pairs.size(); ++i)
      if ((lit.empty() || lit[i]) && has_weight(mixtures, weights, i)) wanted.push_back(i);
    for (std::uint32_t i : wanted) decisions[i] = Decision::kDrawn;
    return draw_normals(basis, pairs, mixtures, weights, wanted, radiance, counts);
  }
  const std::size_t hits = pairs.size();
  std::vector<Modelled> modelled;
  modelled.reserve(padded(hits) / kLanes);
  Calls at_mean, at_brightest;
  for (std::size_t hit = 0; hit < hits; hit += kLanes) {
    const PairLanes pair{load(pairs.to_light, hit), load(pairs.to_viewer, hit)};
    modelled.push_back(model_hits(lobes.model, lobes.in_use, mixtures, weights, pair, lit, hit, hits));
    const Modelled& m = modelled.back();
    const std::size_t count = std::min(kLanes, hits - hit);
    if (!given) at_mean.add(hit, count, m.weight > 0.0f && m.part < 1.0f, m.mean, pair);
    const lanes::Bool convolved = m.weight > 0.0f && m.part > 0.0f;
    at_brightest.add(hit, count, convolved, m.brightest, pair);
    for (std::size_t lane = 0; lane < count; ++lane)
      if (convolved.v[lane]) decisions[hit + lane] = std::max(decisions[hit + lane], Decision::kConvolved);
  }
  Planes<3> mean_answers(given ? 0 : hits), brightest_answers(hits);
  scatter(at_mean, *patterns_, basis, mean_answers);
  scatter(at_brightest, *patterns_, basis, brightest_answers);
  counts.shader_calls += at_mean.size() + at_brightest.size();
  for (std::size_t hit = 0; hit < hits; hit += kLanes) {
    const Modelled& m = modelled[hit / kLanes];
    ColourLanes mean = load_colour(given ? *given : mean_answers, hit);
    if (!given)
      for (Float& channel : mean) channel *= m.weight;
    const ColourLanes a = corrected(m.whole, m.at_mean, mean, m.weight);
    const ColourLanes b = calibrated(m.whole, m.at_brightest, load_colour(brightest_answers, hit));
    for (int c = 0; c < 3; ++c) {
      const Float value =
          lanes::select(m.part <= 0.0f, a[c], lanes::select(m.part >= 1.0f, b[c], a[c] + m.part * (b[c] - a[c])));
      lanes::store(radiance[c] + hit, lanes::select(m.weight > 0.0f, value, 0.0f));
    }
  }
}

}  // namespace redmap
