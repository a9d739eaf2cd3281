#include "export/material_fit.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace redmap {
namespace {

/// Patterns whose reflectance is a known material.
class KnownPatterns : public BoundPatterns {
 public:
  explicit KnownPatterns(const GltfMaterial& material) : material_(material) {}
  std::size_t size() const override { return 1; }
  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override { radiance_one(0, pairs, out); }
  void radiance_one(std::size_t, const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto c = gltf_radiance(numbers_of(material_), {pairs.to_light.get(i), pairs.to_viewer.get(i)});
      out.set(i, Vec3{static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])});
    }
  }
  void radiance_all(const DirectionPairs&, LaneVector<float>&) const override { FAIL() << "fits ask for one pattern"; }
  void transmittance(Planes<3>& out) const override {
    out = Planes<3>(1);
    out.set(0, Vec3{passes, passes, passes});
  }
  void emission(Planes<3>& out) const override {
    out = Planes<3>(1);
    out.set(0, Vec3{material_.emission.r, material_.emission.g, material_.emission.b});
  }
  bool materials(Materials&) const override { return false; }

  float passes = 0;

 private:
  GltfMaterial material_;
};

GltfMaterial paint() {
  GltfMaterial m;
  m.base_color = {0.7f, 0.4f, 0.1f};
  m.roughness = 0.35f, m.specular = 1, m.specular_color = {1, 1, 1};
  return m;
}

TEST(MaterialFit, MaterialOfGltf_IsFoundAgain) {
  const MaterialFit fit = fit_material(KnownPatterns(paint()), 0);
  EXPECT_LT(fit.error, 2e-3f);
  EXPECT_NEAR(fit.material.roughness, 0.35f, 0.01f);
  EXPECT_NEAR(fit.material.base_color.r * (1 - fit.material.metallic), 0.7f, 0.02f);
}

TEST(MaterialFit, Metal_IsFoundAgain_WithoutDiffuse) {
  GltfMaterial gold = paint();
  gold.metallic = 1;
  const MaterialFit fit = fit_material(KnownPatterns(gold), 0);
  EXPECT_LT(fit.error, 5e-3f);
  EXPECT_NEAR(fit.material.roughness, 0.35f, 0.01f);
}

TEST(MaterialFit, CoatOverRoughPaint_NeedsACoat) {
  GltfMaterial lacquer = paint();
  lacquer.roughness = 0.8f, lacquer.coat = 1, lacquer.coat_roughness = 0.15f;
  const MaterialFit fit = fit_material(KnownPatterns(lacquer), 0);
  EXPECT_LT(fit.error, 0.02f);
  EXPECT_GT(fit.material.coat, 0.5f);
}

TEST(MaterialFit, GrainOfMetal_IsFoundAgain) {
  GltfMaterial brushed = paint();
  brushed.metallic = 1, brushed.roughness = 0.3f, brushed.anisotropy = 0.5f, brushed.anisotropy_rotation = 0.7f;
  const MaterialFit fit = fit_material(KnownPatterns(brushed), 0);
  EXPECT_LT(fit.error, 5e-3f);
  EXPECT_NEAR(fit.material.anisotropy, 0.5f, 0.02f);
  EXPECT_NEAR(fit.material.anisotropy_rotation, 0.7f, 0.02f);
}

TEST(MaterialFit, MetalWithoutGrain_StaysIsotropic) {
  GltfMaterial gold = paint();
  gold.metallic = 1;
  EXPECT_EQ(fit_material(KnownPatterns(gold), 0).material.anisotropy, 0);
}

TEST(MaterialFit, LightThatPassesAndLightOfItsOwn_AreTakenOver) {
  GltfMaterial glass = paint();
  glass.emission = {0, 2, 0};
  KnownPatterns patterns(glass);
  patterns.passes = 0.3f;
  const MaterialFit fit = fit_material(patterns, 0);
  EXPECT_NEAR(fit.material.emission.g, 2, 1e-6f);
  const float all = (fit.material.base_color.r + fit.material.base_color.g + fit.material.base_color.b) / 3;
  EXPECT_NEAR(fit.material.transmission * all, 0.3f, 1e-3f);
}

/// A shader of the library at one place, whose frame is the axes.
MaterialFit fit_of_library(const std::string& name) {
  const auto shader = make_library_shader(name);
  SurfacePoints points;
  points.resize(1);
  for (std::size_t i = 0; i < points.position.stride(); ++i)
    points.position.set(i, Vec3{0.3f, 0.2f, 0.1f}), points.normal.set(i, Vec3{0, 0, 1}),
        points.tangent.set(i, Vec3{1, 0, 0});
  return fit_material(*shader->bind(points), 0);
}

TEST(MaterialFit, LibraryShaderOfPhongLobes_IsNoGltf_AndSaysSo) { EXPECT_GT(fit_of_library("checker").error, 0.01f); }

// Two implementations of one anisotropic lobe: ours is fitted to that of the library's shaders.
TEST(MaterialFit, AnisotropicMetalOfTheLibrary_IsGltf) {
  const MaterialFit fit = fit_of_library("scratched_metal");
  EXPECT_LT(fit.error, 2e-3f);
  // .25 across the grooves, along them .08, each the square of glTF's roughness.
  const GltfMaterial& m = fit.material;
  const float least = m.roughness * m.roughness, most = least + (1 - least) * m.anisotropy * m.anisotropy;
  EXPECT_NEAR(least, 0.08f, 1e-3f);
  EXPECT_NEAR(most, 0.25f, 2e-3f);
}

TEST(GltfMaterial, SquaredRoughness_IsSaidAndRead) {
  const GltfRoughness said = roughness_of(squared_roughness(0.4, 0.6, -0.5));
  EXPECT_NEAR(said.roughness, 0.4f, 1e-5f);
  EXPECT_NEAR(said.anisotropy, 0.6f, 1e-5f);
  EXPECT_NEAR(said.rotation, -0.5f, 1e-5f);
}

// Two implementations of one microfacet lobe: ours for materials of glTF, and that of the library's shaders.
TEST(GltfMaterial, Metal_ReflectsAsTheLibrarysGgx) {
  GltfMaterial metal = paint();
  metal.metallic = 1;
  const float alpha = metal.roughness * metal.roughness;
  Random random(3);
  constexpr std::size_t kPairs = 64;
  DirectionPairs pairs;
  Materials materials;
  pairs.resize(kPairs), materials.resize(kPairs);
  const auto direction = [&] {
    const float z = 0.05f + 0.95f * random.next_float(), turn = 2 * kPi * random.next_float();
    const float r = std::sqrt(1 - z * z);
    return Vec3{r * std::cos(turn), r * std::sin(turn), z};
  };
  for (std::size_t i = 0; i < kPairs; ++i) {
    pairs.to_light.set(i, direction()), pairs.to_viewer.set(i, direction());
    materials.diffuse.set(i, Vec3{}), materials.transmittance.set(i, Vec3{}), materials.normals.set(i, Vec3{});
    materials.specular.set(i, Vec3{metal.base_color.r, metal.base_color.g, metal.base_color.b});
    materials.exponent[0][i] = 1, materials.ggx[0][i] = 1, materials.grazing[0][i] = 1;
    materials.roughness.set(i, Vec3{alpha * alpha, 0, alpha * alpha});
  }
  Planes<3> expected;
  material_radiance_each(materials, pairs, expected);
  for (std::size_t i = 0; i < kPairs; ++i) {
    const auto found = gltf_radiance(numbers_of(metal), {pairs.to_light.get(i), pairs.to_viewer.get(i)});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], static_cast<double>(expected[c][i]), 2e-4 + 1e-3 * found[c]) << i;
  }
}

}  // namespace
}  // namespace redmap
