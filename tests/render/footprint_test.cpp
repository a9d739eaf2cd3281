#include <gtest/gtest.h>

#include "render/hit_footprint.h"
#include "render_test_support.h"

namespace redmap {
namespace {

/// uv where the ray through (x, y) meets the first object.
Vec2 uv_at(const Tracer& tracer, const Scene& scene, const CameraRays& camera, float x, float y, SurfaceHit* surface) {
  const Ray ray{camera.origin, normalized(camera.unnormalised(x, y))};
  RayHit hit;
  tracer.intersect({&ray, 1}, {&hit, 1});
  scene.objects[0].surface->complete({&hit.where, 1}, {surface, 1});
  return surface->uv;
}

TEST(CameraFootprint, AgreesWithFiniteDifferencesOfTheHit) {
  Scene scene = test::sphere_scene(std::make_shared<test::LambertShader>(1.0f, 0.0f), {0, 0, 1}, 200);
  scene.objects[0].transform = {{0.1f, -0.2f, 0.3f}, {20, 30, 40}, 1.3f};
  Tracer tracer(scene);
  tracer.set_frame(scene);
  const CameraRays camera = make_camera_rays(scene.camera);
  const Placement& placement = tracer.placement(0);
  constexpr float kStep = 0.5f;
  for (const Vec2 at : {Vec2{100, 100}, Vec2{130, 90}, Vec2{95, 120}}) {
    SurfaceHit hit, unused;
    uv_at(tracer, scene, camera, at.x, at.y, &hit);
    const DirectionDifferential world = direction_differential(camera, at.x, at.y);
    const Footprint footprint =
        camera_footprint(hit, placement.direction_object(normalized(camera.unnormalised(at.x, at.y))),
                         {placement.direction_object(world.dx), placement.direction_object(world.dy)},
                         length(hit.position - placement.point_object(camera.origin)), 1);
    const Vec2 dx = (uv_at(tracer, scene, camera, at.x + kStep, at.y, &unused) -
                     uv_at(tracer, scene, camera, at.x - kStep, at.y, &unused)) *
                    (0.5f / kStep);
    const Vec2 dy = (uv_at(tracer, scene, camera, at.x, at.y + kStep, &unused) -
                     uv_at(tracer, scene, camera, at.x, at.y - kStep, &unused)) *
                    (0.5f / kStep);
    EXPECT_LT(length(footprint.duv_dx - dx), 0.01f * length(dx)) << at.x;
    EXPECT_LT(length(footprint.duv_dy - dy), 0.01f * length(dy)) << at.x;
  }
}

TEST(RoundFootprint, HasTheAreaOfItsSquareOnTheSurface) {
  const auto sphere = make_sphere(2);
  const HitCoordinates where{0, {0.3f, 0.4f}};
  SurfaceHit hit;
  sphere->complete({&where, 1}, {&hit, 1});
  const Footprint footprint = round_footprint(hit, 0.01f);
  const float area = std::abs(cross(footprint.duv_dx, footprint.duv_dy)) * length(cross(hit.dp_du, hit.dp_dv));
  EXPECT_NEAR(area, 1e-4f, 1e-7f);
}

}  // namespace
}  // namespace redmap
