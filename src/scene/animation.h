// How a scene moves: keys with straight lines between them, and turntables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace redmap {

/// The value of something at a frame; scalars use x alone.
struct AnimationKey {
  int frame = 1;
  Vec3 value;
};

/// One thing that moves.
struct AnimationTrack {
  std::string target;              ///< as the scene file calls it: "camera.position"
  std::vector<AnimationKey> keys;  ///< ascending frames, each once; at least one
  std::function<void(Scene&, Vec3)> apply;
};

/// An object that turns about y, from its rotation at frame 1.
struct Turntable {
  std::size_t object = 0;  ///< index into Scene::objects; of a mesh in tiles the first, whom the others follow
  float degrees_per_frame = 1;
};

struct Animation {
  int frame_count = 1;
  float frames_per_second = 24;
  std::vector<AnimationTrack> tracks;
  std::optional<Turntable> turntable;
};

/// Linear between the keys around `frame`, the first or last key's value outside them.
Vec3 interpolate(const std::vector<AnimationKey>& keys, int frame);

/// `scene`, the scene at rest, at `frame`: tracks, then the turntable, and time 0 at frame 1.
Scene animate(const Scene& scene, const Animation& animation, int frame);

}  // namespace redmap
