#include "verify/weight_probe.h"

#include <gtest/gtest.h>

#include "bake/bake.h"
#include "render/hit_footprint.h"
#include "verify/measured_pixel.h"

namespace redmap {
namespace {

TEST(WeightProbe, ReadsOutOfAFrame_WhatALookupGives) {
  Object object;
  object.surface = make_sphere(1);
  object.shader = make_library_shader("scales");
  BakeOptions bake_options;
  bake_options.size = 128;
  const auto map = std::make_shared<ReductionMap>(bake(*object.surface, *object.shader, bake_options));
  ASSERT_EQ(map->basis.size(), 3u);
  const auto probe = make_map_shading(make_weight_probe(0), map, object.surface);
  const PixelRenderer renderer(object);
  const auto pixels = draw_interior_pixels(renderer, *map, {Quality::kFast, {4}, 20, 0});
  ASSERT_GT(pixels.size(), 10u);
  for (PixelCase pixel : pixels) {
    pixel.light.intensity = {};
    const RenderedPixel rendered = renderer.frame(pixel, probe, Quality::kFast, false);
    if (rendered.decision == Decision::kSubdivided) continue;
    SurfaceHit hit;
    object.surface->complete({&pixel.where, 1}, {&hit, 1});
    const CameraRays camera = make_camera_rays(pixel.camera);
    const Vec3 direction = normalized(camera.unnormalised(0.5f, 0.5f));
    const Footprint footprint = camera_footprint(hit, direction, direction_differential(camera, 0.5f, 0.5f),
                                                 length(hit.position - pixel.camera.position), 1);
    const FilteredTexel texel = map->weights.lookup(footprint);
    EXPECT_NEAR(rendered.value.r, texel.channel[0], 2e-3f);
    EXPECT_NEAR(rendered.value.g, texel.channel[1], 2e-3f);
    EXPECT_NEAR(rendered.value.b, texel.channel[2], 2e-3f);
  }
}

}  // namespace
}  // namespace redmap
