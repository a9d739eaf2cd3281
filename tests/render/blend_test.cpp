// The way from the shader itself to its map: a camera that backs away must see no pop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/bake.h"
#include "render_test_support.h"

namespace redmap {
namespace {

double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - double(b.data[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.data.size()));
}

/// Largest RMS difference of two frames that follow each other while the footprint grows from .3 to 3 texels.
double largest_step(Scene scene, const RenderOptions& options, const ObjectData& data) {
  Renderer renderer(scene, options, {data});
  constexpr int kFrames = 40;
  Image previous;
  double largest = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    scene.camera.position = {0, 0, 1 + 1.2f * std::pow(10.0f, static_cast<float>(frame) / kFrames)};
    const Image image = renderer.render(scene, frame).image;
    if (frame > 0) largest = std::max(largest, rms_difference(image, previous));
    previous = image;
  }
  return largest;
}

TEST(Blend, BackingAway_StepsNoFurtherThanTheReferenceDoes) {
  for (const char* name : {"checker", "marble"}) {
    Scene scene = test::sphere_scene(make_library_shader(name), {1, 1, 1}, 28);
    scene.camera.vertical_fov_degrees = 6;
    // 1.2 units away a pixel is 3.1 mm wide on the sphere, and a texel of 300 x 600 is 10.5 mm.
    BakeOptions bake_options;
    bake_options.size = 300;
    const auto map =
        std::make_shared<const ReductionMap>(bake(*scene.objects[0].surface, *scene.objects[0].shader, bake_options));
    RenderOptions reference;
    reference.method = Method::kSupersample;
    reference.spp = 144;
    const double step = largest_step(scene, {}, {map, nullptr, nullptr});
    EXPECT_LE(step, 1.1 * largest_step(scene, reference, {})) << name;
    EXPECT_GT(step, 0) << name;
  }
}

}  // namespace
}  // namespace redmap
