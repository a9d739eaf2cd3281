// Black boxes answer in object space; from outside nobody can tell.
#include <gtest/gtest.h>

#include "shader/library_shader.h"
#include "shader/parameter_values.h"
#include "shader_test_support.h"

// Last, since it gives GLSL's type names their meaning.
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
#include "shader/library/checker.glsl"
#include "shader/library/include/frame.glsl"

// The checkerboard again, as a black box.
vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  return radiance(pattern(at, p), to_shading_frame(at, to_light), to_shading_frame(at, to_viewer));
}
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

template <typename Form>
Planes<3> radiance_of(const SurfacePoints& points, const DirectionPairs& pairs) {
  const ShaderInfo& info = library_shader_info("checker");
  const library::LibraryShader<Form, glsl::Surface, glsl::Vec3, text::Parameters> shader(info,
                                                                                         parameter_values(info, {}));
  Planes<3> out;
  shader.bind(points)->radiance_each(pairs, out);
  return out;
}

TEST(BlackBox, EqualsTheSplitFormOfTheSameMaterial_InAnyFrame) {
  using Split = library::SplitForm<glsl::Surface, glsl::Vec3, text::Parameters, text::Pattern>;
  using BlackBox = library::BlackBoxForm<glsl::Surface, glsl::Vec3, text::Parameters>;
  const SurfacePoints points = test::random_points(1000, 1);
  const DirectionPairs pairs = test::random_pairs(1000, 2);
  const Planes<3> split = radiance_of<Split>(points, pairs), black_box = radiance_of<BlackBox>(points, pairs);
  for (std::size_t i = 0; i < 1000; ++i)
    for (auto c : {0, 1, 2}) EXPECT_NEAR(black_box[c][i], split[c][i], 1e-4 * (1 + split[c][i]));
}

TEST(BlackBox, TurnedTangentAndTurnedDirections_GiveTheSame) {
  for (const char* name : {"toon_black_box", "lacquer_black_box"}) {
    const auto shader = make_library_shader(name);
    SurfacePoints points = test::random_points(500, 3);
    DirectionPairs pairs = test::random_pairs(500, 4);
    Planes<3> before, after;
    shader->bind(points)->radiance_each(pairs, before);

    // A quarter turn about the normal: the new tangent is the old bitangent, so that (x, y) becomes (y, -x).
    for (std::size_t i = 0; i < 500; ++i) {
      points.tangent.set(i, cross(points.normal.get(i), points.tangent.get(i)));
      for (Planes<3>* directions : {&pairs.to_light, &pairs.to_viewer}) {
        const Vec3 v = directions->get(i);
        directions->set(i, Vec3{v.y, -v.x, v.z});
      }
    }
    shader->bind(points)->radiance_each(pairs, after);

    // Rounding may cross an edge of a cartoon band, but hardly ever.
    std::size_t different = 0;
    for (std::size_t i = 0; i < 500; ++i)
      for (auto c : {0, 1, 2}) different += std::abs(after[c][i] - before[c][i]) > 1e-3 * (1 + before[c][i]);
    EXPECT_LE(different, 6u) << name;
  }
}

}  // namespace
}  // namespace redmap
