// Lobe models of the library's reflectances: the validation tells those that can be integrated from those that cannot.
#include "analysis/lobe_fit.h"

#include <gtest/gtest.h>

namespace redmap {
namespace {

LobeModel fit_library(const char* name, Vec3 position = {0.1f, 0.2f, 0.3f}) {
  const std::shared_ptr<const Shader> shader = make_library_shader(name);
  SurfacePoints points;
  points.resize(1);
  for (std::size_t i = 0; i < points.position.stride(); ++i) {
    points.position.set(i, position), points.normal.set(i, Vec3{0, 0, 1}), points.tangent.set(i, Vec3{1, 0, 0});
    points.uv.set(i, Vec2{0.3f, 0.4f});
  }
  return fit_lobes(*shader->bind(points), 0);
}

TEST(LobeFit, OfLambert_IsACosine) {
  const LobeModel model = fit_library("white");
  EXPECT_LT(model.error, 0.03f);
  for (const LobeModel::Angle& angle : model.angles) {
    EXPECT_NEAR(angle.cosine[0], 0.8f / 3.14159265f, 0.1f);
    EXPECT_LT(angle.constant[0], 0.01f);
  }
}

TEST(LobeFit, OfPhongAndGgx_CanBeIntegrated) {
  for (const char* name : {"scales", "marble", "chrome_rubber", "hammered_metal", "ridges"})
    EXPECT_LT(fit_library(name).error, 0.2f) << name;
}

TEST(LobeFit, OfToonAndAnisotropic_ReportsThatItIsOfNoUse) {
  EXPECT_GT(fit_library("toon_black_box").error, 0.2f);
  EXPECT_GT(fit_library("scratched_metal").error, 0.2f);
}

}  // namespace
}  // namespace redmap
