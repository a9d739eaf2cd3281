#include "scene/camera_controls.h"

#include <gtest/gtest.h>

namespace redmap {
namespace {

Camera camera_at(Vec3 position) {
  Camera camera;
  camera.position = position;
  return camera;
}

TEST(CameraControls, OrbitByAQuarter_IsOnTheOtherAxis) {
  Camera camera = camera_at({0, 0, 5});
  orbit(camera, 90, 0);
  EXPECT_NEAR(camera.position.x, 5, 1e-5);
  EXPECT_NEAR(camera.position.z, 0, 1e-5);
}

TEST(CameraControls, OrbitUp_RaisesTheCamera_AndKeepsItsDistance) {
  Camera camera = camera_at({0, 0, 5});
  orbit(camera, 0, 30);
  EXPECT_NEAR(camera.position.y, 2.5, 1e-5);
  EXPECT_NEAR(length(camera.position), 5, 1e-5);
}

TEST(CameraControls, OrbitOverTheTop_StopsBeforeIt) {
  Camera camera = camera_at({0, 0, 5});
  orbit(camera, 0, 500);
  EXPECT_GT(camera.position.z, 0);
  EXPECT_GT(camera.position.y, 4.9);
}

TEST(CameraControls, Zoom_ScalesTheDistance) {
  Camera camera = camera_at({0, 3, 4});
  zoom(camera, 0.5f);
  EXPECT_NEAR(length(camera.position), 2.5, 1e-5);
}

TEST(CameraControls, FlyForward_MovesBothEnds) {
  Camera camera = camera_at({0, 0, 5});
  fly(camera, 0, 0, 0.5f);
  EXPECT_NEAR(camera.position.z, 2.5, 1e-5);
  EXPECT_NEAR(camera.look_at.z, -2.5, 1e-5);
  fly(camera, 1, 1, 0);
  EXPECT_NEAR(camera.position.x, 5, 1e-5);
  EXPECT_NEAR(camera.position.y, 5, 1e-5);
}

TEST(CameraControls, LookRight_SeesWhatIsOnTheRight) {
  Camera camera = camera_at({0, 0, 5});
  look(camera, 90, 0);
  EXPECT_NEAR(camera.look_at.x, 5, 1e-5);
  EXPECT_NEAR(camera.look_at.z, 5, 1e-5);
  EXPECT_EQ(camera.position, (Vec3{0, 0, 5}));
}

}  // namespace
}  // namespace redmap
