// What verify() says is wrong: assumptions of the map that are broken on purpose, one at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bake/bake.h"
#include "shader/patterns_by_function.h"
#include "surface/atlas.h"
#include "surface/mesh.h"
#include "surface/shapes.h"
#include "verify/verify.h"

namespace redmap {
namespace {

/// Grey radiance of one stripe or the other, directions in the shading frame, both above the horizon.
using StripeRadiance = std::function<float(bool in_stripe, Vec3 to_light, Vec3 to_viewer)>;

class StripedPatterns : public PatternsByFunction {
 public:
  StripedPatterns(const SurfacePoints& points, const StripeRadiance& radiance)
      : in_stripe_(points.size()), radiance_(radiance) {
    for (std::size_t i = 0; i < points.size(); ++i) in_stripe_[i] = std::sin(6 * points.position.get(i).y) > 0;
  }
  std::size_t size() const override { return in_stripe_.size(); }

 private:
  Vec3 radiance(std::size_t pattern, const DirectionPairs& pairs, std::size_t pair) const override {
    const Vec3 light = pairs.to_light.get(pair), viewer = pairs.to_viewer.get(pair);
    if (light.z <= 0 || viewer.z <= 0) return {};
    const float value = radiance_(in_stripe_[pattern], light, viewer);
    return {value, value, value};
  }
  std::vector<bool> in_stripe_;
  StripeRadiance radiance_;
};

class StripedShader : public Shader {
 public:
  explicit StripedShader(StripeRadiance radiance) : radiance_(std::move(radiance)) { info_.name = "striped"; }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<StripedPatterns>(points, radiance_);
  }

 private:
  StripeRadiance radiance_;
  ShaderInfo info_;
  ParameterValues parameters_;
};

Object striped_ball(StripeRadiance radiance) {
  Object object;
  object.name = "ball", object.surface = make_sphere(1);
  object.shader = std::make_shared<StripedShader>(std::move(radiance));
  return object;
}

/// Matt, and in the stripes a lobe whose width along the tangent is another than across it.
float brushed(bool in_stripe, Vec3 to_light, Vec3 to_viewer) {
  const Vec3 half = normalized(to_light + to_viewer);
  const float along = in_stripe ? 0.15f : 0.3f, across = in_stripe ? 0.7f : 0.3f;
  const float x = half.x / (half.z * along), y = half.y / (half.z * across);
  return to_light.z * (0.1f + 0.6f * std::exp(-0.5f * (x * x + y * y)));
}

/// Matt, and in the stripes a lobe sideways of the light as well: isotropic, but nil in the plane of incidence and
/// wherever light or viewer are near the normal, which is where the paper's table looks.
float sideways(bool in_stripe, Vec3 to_light, Vec3 to_viewer) {
  const float across = to_light.x * to_viewer.y - to_light.y * to_viewer.x;
  const float lobe = std::clamp(3 * (std::abs(across) - 0.25f), 0.0f, 1.0f);
  return to_light.z * (in_stripe ? 0.2f + 0.5f * lobe : 0.2f);
}

std::string reason_of(const Object& object, std::shared_ptr<const ReductionMap> map, std::vector<float> minifications,
                      const std::string& weakest) {
  VerifyOptions options;
  options.minifications = std::move(minifications);
  options.pixels = 60, options.spp = 256;
  const VerifyReport report = verify(object, std::move(map), options);
  EXPECT_EQ(report.certificate.weakest, weakest) << report.certificate.reason;
  return report.certificate.reason;
}

std::shared_ptr<ReductionMap> map_of(const Object& object, int size, float tolerance = 0.025f) {
  BakeOptions options;
  options.size = size, options.tolerance = tolerance;
  return std::make_shared<ReductionMap>(bake(*object.surface, *object.shader, options));
}

TEST(Reasons, BasisWithoutTheGrain_IsAnisotropy) {
  const Object object = striped_ball(brushed);
  const auto map = map_of(object, 128);
  ASSERT_EQ(map->basis.size(), 2u);
  // Of two reflectances, one of which has a grain, that which has none stands for both.
  const auto in_stripe = [](const BasisPlace& place) { return std::sin(6 * place.position.y) > 0; };
  ASSERT_NE(in_stripe(map->basis[0]), in_stripe(map->basis[1]));
  map->basis[in_stripe(map->basis[0]) ? 0 : 1] = map->basis[in_stripe(map->basis[0]) ? 1 : 0];
  const std::string reason = reason_of(object, map, {1, 2}, "fit");
  EXPECT_NE(reason.find("the reflectance is anisotropic"), std::string::npos) << reason;
}

TEST(Reasons, LobeWhereNoDirectionOfTheTableLooks_IsOffSpecular) {
  const Object object = striped_ball(sideways);
  // A tolerance that lets the disagreement of held-out directions pass: what is left is for verify() to see.
  const auto map = map_of(object, 64, 0.6f);
  ASSERT_EQ(map->basis.size(), 1u);
  ASSERT_LT(map->residual, 0.01f);
  const std::string reason = reason_of(object, map, {1, 2}, "fit");
  EXPECT_NE(reason.find("off-specular"), std::string::npos) << reason;
}

/// The map's base as if all of the atlas were covered, by black where there is no chart, and its pyramid.
void fill_gutters_with_black(ReductionMap& map) {
  const WeightPyramid& weights = map.weights;
  BaseLevel base(weights.extent(0), weights.channels(), weights.wraps_u());
  for (int y = 0; y < base.extent.height; ++y)
    for (int x = 0; x < base.extent.width; ++x) {
      const std::size_t t = static_cast<std::size_t>(y) * base.extent.width + x;
      base.coverage[t] = 1;
      if (weights.coverage(0, x, y) == 0) continue;
      for (int c = 0; c < base.channels; ++c) base.values[t * base.channels + c] = weights.value(0, x, y, c);
    }
  map.weights = WeightPyramid(base);
  map.clusters = {};
}

TEST(Reasons, GuttersThatCount_AreALeakOfTheAtlas) {
  constexpr int kSize = 128;
  TriangleMesh mesh = icosphere(3);
  AtlasOptions options;
  options.resolution = kSize;
  unwrap(mesh, options);
  compute_normals(mesh);
  Object object;
  object.name = "ball", object.surface = make_mesh_surface(std::move(mesh));
  object.shader = make_library_shader("white");
  const auto map = map_of(object, kSize);
  fill_gutters_with_black(*map);
  const std::string reason = reason_of(object, map, {2, 4}, "filter");
  EXPECT_NE(reason.find("the atlas leaks"), std::string::npos) << reason;
}

}  // namespace
}  // namespace redmap
