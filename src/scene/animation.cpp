#include "scene/animation.h"

#include <algorithm>
#include <cmath>

namespace redmap {

namespace {

/// Whole turns are taken off in double: what is left is as exact at the last frame as at the second.
void turn(Scene& moment, const Turntable& turntable, int frame) {
  float& angle_degrees = moment.objects[turntable.object].transform.rotate_degrees.y;
  const double turned_degrees = std::fmod(static_cast<double>(turntable.degrees_per_frame) * (frame - 1), 360.0);
  angle_degrees = static_cast<float>(angle_degrees + turned_degrees);
}

}  // namespace

Vec3 interpolate(const std::vector<AnimationKey>& keys, int frame) {
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), frame, [](int at, const AnimationKey& key) { return at < key.frame; });
  if (after == keys.begin()) return keys.front().value;
  const AnimationKey& before = *(after - 1);
  if (after == keys.end() || before.value == after->value) return before.value;
  const auto span = static_cast<float>(after->frame - before.frame);
  return lerp(before.value, after->value, static_cast<float>(frame - before.frame) / span);
}

Scene animate(const Scene& scene, const Animation& animation, int frame) {
  Scene moment = scene;
  for (const AnimationTrack& track : animation.tracks) track.apply(moment, interpolate(track.keys, frame));
  if (animation.turntable) turn(moment, *animation.turntable, frame);
  moment.time_seconds = static_cast<float>(frame - 1) / animation.frames_per_second;
  for (Light& light : moment.lights) light.to_light = normalized(light.to_light);
  // Tiles of a mesh stand where the first of them does.
  for (std::size_t i = 1; i < moment.objects.size(); ++i)
    if (is_further_tile(moment, i)) moment.objects[i].transform = moment.objects[i - 1].transform;
  return moment;
}

}  // namespace redmap
