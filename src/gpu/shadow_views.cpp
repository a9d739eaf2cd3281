#include "gpu/shadow_views.h"

#include <algorithm>
#include <cmath>

#include "scene/camera_rays.h"
#include "scene/placement.h"

namespace redmap {
namespace {

/// Sine of half the angle that one perspective view may take in: 45 degrees; beyond, texels at its rim get too coarse.
constexpr float kWidestSine = 0.7071f;
/// What views see beyond the ball, as a part of it: texels at the rim are compared with their neighbours.
constexpr float kMargin = 1.02f;
/// The nearest that anything is drawn, as a part of the ball.
constexpr float kNearest = 1e-4f;

bool is_outside(const Light& light, const Ball& ball) {
  return length(light.position - ball.centre) * kWidestSine > ball.radius;
}

Vec3 any_perpendicular(Vec3 v) {
  return normalized(std::abs(v.x) > 0.7f ? cross(Vec3{0, 1, 0}, v) : cross(Vec3{1, 0, 0}, v));
}

/// A square view of `size` texels that reaches `half` (at distance 1, or in all for parallel rays) to each side.
ViewBlock square_view(Vec3 eye, Vec3 forward, Vec3 right, float half, int size) {
  const Vec3 down = cross(forward, right);
  const float texel = 2 * half / static_cast<float>(size), edge = static_cast<float>(size);
  ViewBlock view;
  view.eye = {eye, 0};
  view.top_left = {forward - (right + down) * half, 0};
  view.right = {right * texel, edge}, view.down = {down * texel, edge};
  view.forward = {forward, 0};
  return view;
}

ViewBlock directional_view(const Light& light, const Ball& ball, int size) {
  const float half = kMargin * ball.radius;
  const Vec3 forward = -light.to_light, right = any_perpendicular(forward), down = cross(forward, right);
  const Vec3 corner = ball.centre - forward * half - (right + down) * half;
  ViewBlock view = square_view(corner, forward, right, half, size);
  view.eye.w = 1, view.top_left = {forward, 0};
  view.forward.w = 2 * half;
  return view;
}

/// As ViewBlock has them: cube faces in the order +x, -x, +y, -y, +z, -z.
void add_point_views(const Light& light, const Ball& ball, int size, std::vector<ViewBlock>& views) {
  const float nearest = kNearest * ball.radius;
  const auto add = [&](Vec3 forward, float half) {
    views.push_back(square_view(light.position, forward, any_perpendicular(forward), half, size));
    views.back().top_left.w = nearest;
  };
  if (is_outside(light, ball)) {
    const Vec3 path = ball.centre - light.position;
    const float sine = std::min(kMargin * ball.radius / length(path), kWidestSine);
    return add(normalized(path), sine / std::sqrt(1 - sine * sine));
  }
  for (int face = 0; face < 6; ++face) {
    Vec3 forward;
    forward[face / 2] = face % 2 ? -1.0f : 1.0f;
    add(forward, kMargin);
  }
}

}  // namespace

Ball ball_around(const Scene& scene) {
  Vec3 lo{1e30f, 1e30f, 1e30f}, hi = -lo;
  for (const Object& object : scene.objects) {
    const Placement placement = make_placement(object.transform);
    const Vec3 a = object.surface->lower(), b = object.surface->upper();
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = placement.point_world({i & 1 ? a.x : b.x, i & 2 ? a.y : b.y, i & 4 ? a.z : b.z});
      for (int axis = 0; axis < 3; ++axis)
        lo[axis] = std::min(lo[axis], corner[axis]), hi[axis] = std::max(hi[axis], corner[axis]);
    }
  }
  if (scene.objects.empty()) return {{}, 1};
  return {(lo + hi) * 0.5f, std::max(0.5f * length(hi - lo), 1e-20f)};
}

int shadow_view_count(const Scene& scene) {
  const Ball ball = ball_around(scene);
  int count = 0;
  for (const Light& light : scene.lights)
    if (light.shadows) count += light.type == Light::Type::kDirectional || is_outside(light, ball) ? 1 : 6;
  return count;
}

std::vector<ViewBlock> shadow_views(const Scene& scene, int size, FrameBlock& frame) {
  const Ball ball = ball_around(scene);
  std::vector<ViewBlock> views;
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    frame.lights[l].intensity.w = light.shadows ? static_cast<float>(views.size()) : -1.0f;
    if (!light.shadows) continue;
    if (light.type == Light::Type::kDirectional) {
      views.push_back(directional_view(light, ball, size));
    } else {
      // 2 says that there are six.
      if (!is_outside(light, ball)) frame.lights[l].place.w = 2;
      add_point_views(light, ball, size, views);
    }
  }
  return views;
}

ViewBlock camera_view(const Camera& camera, const Ball& ball, int samples, int first_row, int rows) {
  const CameraRays rays = make_camera_rays(camera);
  const float step = 1 / static_cast<float>(samples);
  const Vec3 down = rays.down_per_pixel * step;
  ViewBlock view;
  view.eye = {rays.origin, 0};
  view.top_left = {rays.top_left + down * static_cast<float>(first_row), kNearest * ball.radius};
  view.right = {rays.right_per_pixel * step, static_cast<float>(camera.width * samples)};
  view.down = {down, static_cast<float>(rows)};
  view.forward = {normalized(camera.look_at - camera.position), 0};
  return view;
}

}  // namespace redmap
