// From where the shadow maps of a scene's lights are drawn. Not part of the public interface.
#pragma once

#include <vector>

#include "gpu/frame_blocks.h"
#include "scene/scene.h"

namespace redmap {

/// A sphere around all objects of `scene`, world space.
struct Ball {
  Vec3 centre;
  float radius = 0;
};
Ball ball_around(const Scene& scene);

/// Views of `size` x `size` texels, one after the other: one a light that sees the ball from outside, six about a light
/// that is in it or close. Sets where each light's begin; lights without shadows get none.
std::vector<ViewBlock> shadow_views(const Scene& scene, int size, FrameBlock& frame);

/// Views that shadow_views() gives.
int shadow_view_count(const Scene& scene);

/// The camera's view of `rows` rows of samples from `first_row` on, `samples` a side of a pixel.
ViewBlock camera_view(const Camera& camera, const Ball& ball, int samples, int first_row, int rows);

}  // namespace redmap
