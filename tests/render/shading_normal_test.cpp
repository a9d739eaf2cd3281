// Shading by shaders that perturb normals: against the analytic answer.
#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "base/error.h"
#include "render/shading.h"
#include "render_test_support.h"
#include "scene/object_data.h"
#include "scene/placement.h"
#include "surface/atlas.h"
#include "surface/mesh.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

/// White Lambert about one normal in object space, whatever the surface's is.
class LeaningLambert : public Shader {
 public:
  explicit LeaningLambert(Vec3 normal) : normal_(normal) { info_.perturbs_normals = info_.has_material = true; }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return parameters_; }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    return std::make_unique<Bound>(lambert_.bind(points), normal_);
  }

 private:
  class Bound : public BoundPatterns {
   public:
    Bound(std::unique_ptr<BoundPatterns> lambert, Vec3 normal) : lambert_(std::move(lambert)), normal_(normal) {}
    std::size_t size() const override { return lambert_->size(); }
    void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
      lambert_->radiance_each(pairs, out);
    }
    void radiance_one(std::size_t i, const DirectionPairs& pairs, Planes<3>& out) const override {
      lambert_->radiance_one(i, pairs, out);
    }
    void radiance_all(const DirectionPairs&, LaneVector<float>&) const override {}
    void transmittance(Planes<3>& out) const override { lambert_->transmittance(out); }
    void emission(Planes<3>& out) const override { lambert_->emission(out); }
    bool materials(Materials&) const override { return false; }
    bool shading_normals(Planes<3>& out) const override {
      out.resize(size());
      for (std::size_t i = 0; i < size(); ++i) out.set(i, normal_);
      return true;
    }

   private:
    std::unique_ptr<BoundPatterns> lambert_;
    Vec3 normal_;
  };

  Vec3 normal_;
  test::LambertShader lambert_{1, 0};
  ShaderInfo info_;
  ParameterValues parameters_;
};

TEST(ShaderShading, TakesTheCosineToTheShadersNormal_NotToTheSurfaces) {
  const Vec3 leaning = normalized({0.3f, -0.2f, 0.9f});
  ShadingBatch batch;
  batch.lights.resize(1);
  batch.lights[0].irradiance.resize(9);
  for (std::size_t i = 0; i < 9; ++i) {
    SurfaceHit hit{};
    hit.normal = hit.geometric_normal = {0, 0, 1};
    hit.tangent = {1, 0, 0};
    hit.rest = {hit.position, hit.normal, hit.tangent};
    batch.hits.push_back(hit);
    batch.turned.push_back(0);
    batch.frames.push_back(make_frame(hit.normal, hit.tangent));
    batch.footprints.push_back({});
    batch.to_viewer.push_back({0, 0, 1});
    const float angle = 0.7f * static_cast<float>(i);
    batch.lights[0].to_light.push_back(normalized({std::cos(angle), std::sin(angle), 1}));
    batch.lights[0].irradiance.set(i, Vec3{1, 2, 3});
  }
  ShadedBatch shaded;
  RenderCounts counts;
  make_shader_shading(std::make_shared<LeaningLambert>(leaning))->shade(batch, shaded, counts);
  for (std::size_t i = 0; i < 9; ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(shaded.radiance[c][i], static_cast<float>(c + 1) * dot(leaning, batch.lights[0].to_light[i]) / kPi,
                  1e-6f);
}

TEST(ShaderShading, BumpsGoWithThePose_AsIfTheObjectHadTurned) {
  // The same turn, once by the object's transform and once by its vertices.
  TriangleMesh rest = bumpy_sphere(4);
  unwrap(rest, {.resolution = 256});
  const auto shader = make_library_shader("hammered_metal", {});
  Scene turned = test::sphere_scene(shader, {0.5f, 0.3f, 1}, 48), posed = turned;
  turned.objects[0].transform.rotate_degrees = {40, 70, 20};
  TriangleMesh pose = rest;
  for (Vec3& p : pose.positions) p = make_placement(turned.objects[0].transform).point_world(p);
  turned.objects[0].surface = make_mesh_surface(rest);
  posed.objects[0].surface = make_posed_surface({rest, pose});
  RenderOptions options;
  options.method = Method::kOriginal;
  const Image a = Renderer(turned, options, {ObjectData{}}).render(turned, 1).image;
  const Image b = Renderer(posed, options, {ObjectData{}}).render(posed, 1).image;
  double difference = 0, power = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    difference += std::pow(a.data[i] - b.data[i], 2), power += std::pow(a.data[i], 2);
  EXPECT_LT(std::sqrt(difference / power), 0.02);
}

/// A pyramid of one value everywhere, for the sphere.
std::shared_ptr<const Pyramid<float>> constant_pyramid(const Surface& surface, std::vector<float> value) {
  BaseLevel base(surface.map_extent(256), static_cast<int>(value.size()), true);
  for (std::size_t i = 0; i < base.values.size(); ++i) base.values[i] = value[i % value.size()];
  std::fill(base.coverage.begin(), base.coverage.end(), 1.0f);
  return std::make_shared<const Pyramid<float>>(base);
}

TEST(ParametersShading, RefusesShadersThatPerturbNormals_WithoutTheirSlopes) {
  try {
    Object object;
    object.shader = std::make_shared<LeaningLambert>(Vec3{0, 0, 1});
    require_parameters(object, {nullptr, constant_pyramid(*make_sphere(1), {1}), nullptr});
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("slopes"), std::string::npos) << error.what();
  }
}

TEST(ParametersShading, OfOneSlopeEverywhere_IsTheShaderAboutThatNormal) {
  // Bumps without height are flat; slopes planted in their pyramid are all that leans.
  const auto shader = make_library_shader("hammered_metal", {{"slope", {0}}, {"roughness", {0.3f}}});
  const Scene scene = test::sphere_scene(shader, {0.3f, 0.2f, 1}, 48);
  const Surface& surface = *scene.objects[0].surface;
  const auto parameters = std::make_shared<const Pyramid<float>>(build_parameter_pyramid(surface, *shader, 256));
  RenderOptions options;
  options.method = Method::kParameters;
  const auto render = [&](std::vector<float> slopes) {
    ObjectData data{nullptr, parameters, nullptr};
    data.slopes = constant_pyramid(surface, std::move(slopes));
    return Renderer(scene, options, {data}).render(scene, 1).image;
  };
  RenderOptions original;
  original.method = Method::kOriginal;
  const Image flat = Renderer(scene, original, {{}}).render(scene, 1).image;
  const Image level = render({0, 0, 0, 0, 0}), leaning = render({0.2f, 0, 0.04f, 0, 0}),
              rough = render({0, 0, 0.02f, 0, 0.02f});
  float largest = 0, leaning_largest = 0;
  double level_peak = 0, rough_peak = 0;
  for (std::size_t i = 0; i < flat.data.size(); ++i) {
    largest = std::max(largest, std::abs(level.data[i] - flat.data[i]));
    leaning_largest = std::max(leaning_largest, std::abs(leaning.data[i] - flat.data[i]));
    level_peak = std::max<double>(level_peak, level.data[i]), rough_peak = std::max<double>(rough_peak, rough.data[i]);
  }
  // What is left is the sphere's own curvature within a pixel.
  EXPECT_LT(largest, 0.02f * static_cast<float>(level_peak));
  EXPECT_GT(leaning_largest, 0.1f * static_cast<float>(level_peak));
  // Squared roughness .09 becomes .13, and the peak goes down with it.
  EXPECT_NEAR(rough_peak / level_peak, 0.09 / 0.13, 0.05);
}

double rmse(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) sum += (a.data[i] - b.data[i]) * (a.data[i] - b.data[i]);
  return std::sqrt(sum / static_cast<double>(a.data.size()));
}

TEST(Renderer, MapsOfBumpyShaders_AreNearerToTheReferenceThan16Samples_WithoutMoreRays) {
  for (const char* name : {"hammered_metal", "brick", "scratched_metal"}) {
    // So near that no silhouette is in the picture: those are a matter of rays.
    Scene scene = test::sphere_scene(make_library_shader(name), {0.4f, 0.5f, 1}, 32);
    scene.camera.position = {0, 0, 3}, scene.camera.vertical_fov_degrees = 24;
    BakeOptions baking;
    baking.size = 512;
    const auto map =
        std::make_shared<const ReductionMap>(bake(*scene.objects[0].surface, *scene.objects[0].shader, baking));
    RenderOptions options;
    options.method = Method::kMap;
    const RenderedFrame frame = Renderer(scene, options, {{map, nullptr, nullptr}}).render(scene, 1);
    EXPECT_EQ(frame.counts.supersampled_pixels, 0u);
    EXPECT_LT(frame.counts.camera_rays, 32u * 32 * 6);
    options.method = Method::kSupersample;
    options.spp = 16;
    const Image few = Renderer(scene, options, {{}}).render(scene, 1).image;
    options.spp = 1024, options.seed = 1;
    const Image reference = Renderer(scene, options, {{}}).render(scene, 1).image;
    EXPECT_LT(rmse(frame.image, reference), rmse(few, reference)) << name;
  }
}

}  // namespace
}  // namespace redmap
