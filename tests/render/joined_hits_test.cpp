#include "render/joined_hits.h"

#include <gtest/gtest.h>

#include "render/hit_footprint.h"
#include "render/wavefront.h"
#include "render_test_support.h"

namespace redmap {
namespace {

constexpr float kWhole = 1;  // side of the squares that may be joined, in pixels

/// Takes any footprint.
class AnyShading : public ObjectShading {
 public:
  void shade(const ShadingBatch&, ShadedBatch&, RenderCounts&) const override {}
  bool needs_footprints() const override { return true; }
  bool takes_joined(const Footprint&) const override { return true; }
  void transmittance(std::span<const SurfaceHit>, std::span<const Footprint>, float, Planes<3>&) const override {}
};

/// What the 2 x 2 samples of a pixel see of a unit sphere, which all of them hit.
struct SeenPixel {
  Scene scene;
  CameraRays camera;
  std::vector<CameraSample> samples;
  ShadingBatch batch;

  SeenPixel(Vec3 eye, int pixels, std::uint32_t pixel)
      : scene(test::sphere_scene(std::make_shared<test::LambertShader>(1.0f, 0.0f), {0, 0, 1}, pixels)) {
    scene.camera.position = eye;
    camera = make_camera_rays(scene.camera);
    append_pixel_samples(pixel, pixels, 2, 2, 0, samples);
    std::vector<HitCoordinates> where;
    for (const CameraSample& sample : samples) {
      const Ray ray = camera_ray(camera, sample);
      where.push_back(scene.objects[0].surface->intersect(ray.origin, ray.direction, 0, ray.t_far)->where);
      batch.to_viewer.push_back(-ray.direction);
    }
    batch.hits.resize(where.size());
    scene.objects[0].surface->complete(where, batch.hits);
    batch.turned.resize(where.size());
    for (const SurfaceHit& hit : batch.hits) batch.frames.push_back(make_frame(hit.normal, hit.tangent));
  }
  JoinedHits join(float largest = kWhole) const {
    return join_hits(samples, std::vector<std::uint32_t>{0, 1, 2, 3}, batch, largest, AnyShading(), true);
  }
};

TEST(JoinedHits, HaveTheFootprintAndTheTurningThatTheRayThroughThePixelsCentreHas) {
  const SeenPixel seen({1.5f, 1.2f, 2.4f}, 64, 30 * 64 + 36);
  const JoinedHits joined = seen.join();
  ASSERT_EQ(joined.first, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(joined.single.empty());

  const CameraSample centre{30 * 64 + 36, 36.5f, 30.5f, 1, 1};
  const Ray ray = camera_ray(seen.camera, centre);
  const Surface& sphere = *seen.scene.objects[0].surface;
  const auto hit = sphere.intersect(ray.origin, ray.direction, 0, ray.t_far);
  SurfaceHit expected;
  sphere.complete({&hit->where, 1}, {&expected, 1});
  const DirectionDifferential per_pixel = direction_differential(seen.camera, centre.x, centre.y);
  const Footprint footprint = camera_footprint(expected, ray.direction, per_pixel, hit->t, 1);

  const SurfaceHit& found = joined.batch.hits[0];
  const Footprint& differences = joined.batch.footprints[0];
  EXPECT_LT(length(differences.duv_dx - footprint.duv_dx), 0.01f * length(footprint.duv_dx));
  EXPECT_LT(length(differences.duv_dy - footprint.duv_dy), 0.01f * length(footprint.duv_dy));
  EXPECT_LT(length(found.uv - expected.uv), 0.01f * length(footprint.duv_dx));
  EXPECT_LT(length(found.normal - expected.normal), 1e-4f);
  EXPECT_LT(length(found.dp_du - expected.dp_du), 0.01f * length(expected.dp_du));
  EXPECT_LT(length(found.dn_dv - expected.dn_dv), 0.01f * length(expected.dn_dv));
  EXPECT_LT(length(joined.batch.to_viewer[0] + ray.direction), 1e-5f);
}

TEST(JoinedHits, AreLitByTheMeanOfWhatArrivesAtEach) {
  SeenPixel seen({0, 0, 3}, 64, 30 * 64 + 36);
  ShadingBatch::Light light{std::vector<Vec3>(4, Vec3{0, 0, 1}), Planes<3>(4)};
  light.irradiance.set(1, Vec3{4, 8, 12});
  seen.batch.lights = {light};
  EXPECT_EQ(seen.join().batch.lights[0].irradiance.get(0), (Vec3{1, 2, 3}));
}

TEST(JoinedHits, GoOnWhereTheMapWraps) {
  // u is 0 and 1 along +x: the pixel in the middle has two samples on either side.
  const JoinedHits joined = SeenPixel({3, 0, 0}, 65, 32 * 65 + 32).join();
  ASSERT_EQ(joined.first.size(), 1u);
  const Footprint& footprint = joined.batch.footprints[0];
  EXPECT_LT(length(footprint.duv_dx) + length(footprint.duv_dy), 0.05f);
  EXPECT_NEAR(joined.batch.hits[0].uv.y, 0.5f, 1e-4f);
  EXPECT_LT(std::abs(footprint.uv.x - std::round(footprint.uv.x)), 1e-4f);
}

TEST(JoinedHits, AreNoneAcrossThePoleOfTheMap_NorAcrossPixels_NorInSquaresThatAreTooLarge) {
  SeenPixel pole({1e-4f, 3, 0}, 65, 32 * 65 + 32);
  EXPECT_EQ(pole.join().single.size(), 4u);

  SeenPixel seen({0, 0, 3}, 64, 30 * 64 + 36);
  EXPECT_EQ(seen.join().first.size(), 1u);
  EXPECT_EQ(seen.join(0.5f).single.size(), 4u);
  seen.samples[3].pixel = 30 * 64 + 37;
  EXPECT_EQ(seen.join().single.size(), 4u);
}

}  // namespace
}  // namespace redmap
