// A shader that perturbs its normals and does not say so: they are found by asking it.
#include <gtest/gtest.h>

#include "analysis/shading_normal.h"
#include "base/random.h"
#include "shader/library_shader.h"

// Last, since it gives GLSL's type names their meaning; plain numbers are `real` from here on.
using real = float;
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
#include "shader/library/include/bump.glsl"
#include "shader/library/include/frame.glsl"
#include "shader/library/include/phong.glsl"

struct Parameters {
  float albedo;
};

vec3 hidden_normal(vec3 position, vec3 normal) { return bumped_normal(normal, 0.3 * unit_bumps(position * 6.0, 2)); }

vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  at.normal = hidden_normal(at.position, at.normal);
  at.tangent = normalize(at.tangent - at.normal * dot(at.normal, at.tangent));
  return phong_radiance(vec3(p.albedo), vec3(0.3), 40.0, to_shading_frame(at, to_light),
                        to_shading_frame(at, to_viewer));
}
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

TEST(BoundPatterns, OfABlackBoxThatHidesItsBumps_BetrayTheirNormals) {
  constexpr std::size_t kPlaces = 200;
  SurfacePoints points;
  points.resize(kPlaces);
  Random random(1);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const auto component = [&] { return 2 * random.next_float() - 1; };
    const Vec3 normal = normalized({component(), component(), component()});
    points.position.set(i, normal), points.normal.set(i, normal);
    points.tangent.set(i, make_frame(normal, {0, 1, 0}).x);
  }
  using Form = library::BlackBoxForm<glsl::Surface, glsl::Vec3, text::Parameters>;
  const library::LibraryShader<Form, glsl::Surface, glsl::Vec3, text::Parameters> shader(library_shader_info("white"),
                                                                                         {{0.4f}});
  const ShadingNormals found = estimate_shading_normals(*shader.bind(points));

  EXPECT_LE(found.calls, 34 * kPlaces);
  real largest_tilt = 0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    ASSERT_TRUE(found.found[i]) << i;
    const Vec3 normal = points.normal.get(i), position = points.position.get(i);
    const auto everywhere = [](Vec3 v) { return glsl::Vec3(glsl::Float(v.x), glsl::Float(v.y), glsl::Float(v.z)); };
    const glsl::Vec3 hidden = text::hidden_normal(everywhere(position), everywhere(normal));
    const Vec3 expected{hidden.x.v[0], hidden.y.v[0], hidden.z.v[0]};
    EXPECT_LT(length(make_frame(normal, points.tangent.get(i)).to_world(found.normal.get(i)) - expected), 2e-5f) << i;
    largest_tilt = std::max(largest_tilt, length(cross(normal, expected)));
  }
  EXPECT_GT(largest_tilt, 0.3f);
}

}  // namespace
}  // namespace redmap
