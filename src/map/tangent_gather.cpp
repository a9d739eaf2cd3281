#include "map/tangent_gather.h"

#include <algorithm>
#include <vector>

#include "map/footprint_texels.h"
#include "map/lookup_limits.h"
#include "map/tangent_moments.h"

namespace redmap {
namespace {

struct WeightedTurn {
  float angle, weight;
};

void gather_level(const WeightPyramid& tangents, int level, const Footprint& footprint, float part,
                  std::vector<WeightedTurn>& out) {
  const std::size_t before = out.size();
  const std::uint8_t* texel_row = nullptr;
  const float steps[] = {tangents.scales()[0] / 255, tangents.scales()[1] / 255};
  float total = 0;
  const auto row = [&](int y) { texel_row = tangents.row(level, y).data(); };
  FootprintTexels(footprint, tangents.extent(level), tangents.wraps_u())
      .for_each(row, [&](int x, const TexelPart& part_of) {
        const std::uint8_t* texel = texel_row + static_cast<std::size_t>(x) * tangents.texel_stride();
        if (texel[0] == 0) return;
        const float moments[] = {steps[0] * static_cast<float>(texel[1]), steps[1] * static_cast<float>(texel[2])};
        const float weight = part_of.area * static_cast<float>(texel[0]);
        for (const Vec2 turn : turns_of(moments)) out.push_back({std::atan2(turn.y, turn.x), weight});
        total += weight;
      });
  for (std::size_t i = before; i < out.size(); ++i) out[i].weight *= part / (2 * total);
}

/// Orders angles of half a turn, which have no first: from behind the widest gap between them on.
void order_by_angle(std::vector<WeightedTurn>& turns) {
  // A grain has no direction: half a turn is none.
  for (WeightedTurn& t : turns) t.angle -= kPi * std::floor(t.angle / kPi);
  std::sort(turns.begin(), turns.end(), [](const WeightedTurn& a, const WeightedTurn& b) { return a.angle < b.angle; });
  std::size_t first = 0;
  float widest = turns.front().angle + kPi - turns.back().angle;
  for (std::size_t i = 1; i < turns.size(); ++i)
    if (const float gap = turns[i].angle - turns[i - 1].angle; gap > widest) widest = gap, first = i;
  for (std::size_t i = 0; i < first; ++i) turns[i].angle += kPi;
  std::rotate(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(first), turns.end());
}

GatheredTurns quantiles(std::vector<WeightedTurn>& turns) {
  GatheredTurns chosen;
  chosen.fill({1, 0});
  if (turns.empty()) return chosen;
  order_by_angle(turns);
  // Each turn lies in the middle of its weight, and between two of them all turns are as likely.
  float total = 0;
  for (WeightedTurn& t : turns) {
    const float middle = total + 0.5f * t.weight;
    total += t.weight;
    t.weight = middle;
  }
  std::size_t next = 0;
  for (int i = 0; i < kGatheredTurns; ++i) {
    const float wanted = total * (static_cast<float>(i) + 0.5f) / kGatheredTurns;
    while (next < turns.size() && turns[next].weight < wanted) ++next;
    const WeightedTurn &high = turns[std::min(next, turns.size() - 1)], &low = turns[next > 0 ? next - 1 : 0];
    const float span = high.weight - low.weight;
    const float part = span > 0 ? std::clamp((wanted - low.weight) / span, 0.0f, 1.0f) : 0;
    const float angle = low.angle + part * (high.angle - low.angle);
    chosen[i] = {std::cos(angle), std::sin(angle)};
  }
  return chosen;
}

}  // namespace

void gather_turns(const WeightPyramid& tangents, std::span<const Footprint> footprints, std::span<GatheredTurns> out) {
  std::vector<WeightedTurn> turns;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    turns.clear();
    if (is_finite(footprints[i])) {
      const GatherPlan plan = plan_gather(footprints[i], tangents.extent(0), tangents.levels(), kGatheredGrainTexels);
      if (plan.coarse_part < 1) gather_level(tangents, plan.level, plan.footprint, 1 - plan.coarse_part, turns);
      if (plan.coarse_part > 0) gather_level(tangents, plan.level + 1, plan.footprint, plan.coarse_part, turns);
    }
    out[i] = quantiles(turns);
  }
}

}  // namespace redmap
