// Verdicts: whether one averaged material would have been enough.
#include "bake/verdict.h"

#include <gtest/gtest.h>

#include "bake/bake.h"

namespace redmap {
namespace {

/// A white surface that says it has light of its own.
class GlowingWhite : public Shader {
 public:
  explicit GlowingWhite(bool emits) : white_(make_library_shader("white")), info_(white_->info()) {
    info_.emits = emits;
  }
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return white_->parameters(); }
  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override { return white_->bind(points); }

 private:
  std::shared_ptr<const Shader> white_;
  ShaderInfo info_;
};

TEST(Verdict, ShadersThatEmit_AreNeverOneMaterial) {
  BakeOptions options;
  options.size = 64;
  EXPECT_EQ(bake(*make_sphere(1), GlowingWhite(false), options).verdict, MapVerdict::kOneMaterial);
  EXPECT_EQ(bake(*make_sphere(1), GlowingWhite(true), options).verdict, MapVerdict::kReduces);
}

TEST(Verdict, MapsRememberTheVersionOfTheShader) {
  BakeOptions options;
  options.size = 16;
  const auto shader = make_library_shader("checker");
  EXPECT_NE(shader->info().text_hash, 0u);
  EXPECT_NE(shader->info().text_hash, make_library_shader("noise")->info().text_hash);
  EXPECT_EQ(bake(*make_sphere(1), *shader, options).shader_hash, shader->info().text_hash);
}

}  // namespace
}  // namespace redmap
