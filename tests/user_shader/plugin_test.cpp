#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/temporary_folder.h"
#include "shader/shader_test_support.h"
#include "user_shader/user_shader.h"

namespace redmap {
namespace {

const std::filesystem::path kFolder = REDMAP_PLUGINS;

TEST(Plugin, TheExample_DeclaresAndComputesWhatItSays) {
  const auto shader = make_user_shader(kFolder / "candy.so", "candy.so", {{{"stripes", {2}}, {"twist", {0}}}, {}, ""});
  EXPECT_EQ(shader->info().summary, "Candy stripes under a sugar coat.");
  EXPECT_EQ(shader->info().parameters.size(), 3u);
  EXPECT_FALSE(shader->info().transmits || shader->info().emits || shader->info().perturbs_normals);
  EXPECT_NE(shader->info().text_hash, 0u);

  const SurfacePoints points = test::random_points(50, 1);
  const DirectionPairs pairs = test::random_pairs(50, 2);
  const auto bound = shader->bind(points);
  Planes<3> each, one, none;
  LaneVector<float> all;
  bound->radiance_each(pairs, each), bound->radiance_all(pairs, all), bound->transmittance(none);
  for (std::size_t i = 0; i < 50; ++i) {
    // Two stripes of each colour around the axis.
    const Vec3 p = points.position.get(i);
    const float stripe = std::atan2(p.z, p.x) / kPi;
    const bool is_white = stripe - std::floor(stripe) < 0.5f;
    const Vec3 l = pairs.to_light.get(i), h = normalized(l + pairs.to_viewer.get(i));
    const float expected = (0.02f + (is_white ? 0.83f : 0)) / kPi * l.z + 0.6f * std::pow(h.z, 150.0f) * l.z;
    ASSERT_NEAR(each[1][i], expected, 1e-4f) << i;
    bound->radiance_one(i, pairs, one);
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(one[c][i], each[c][i]);
      ASSERT_EQ(all[(i * 3 + c) * padded(50) + i], each[c][i]);
      ASSERT_EQ(none[c][i], 0);
    }
  }
}

std::string complaint(const std::filesystem::path& file, const char* sin = "") {
  setenv("HOSTILE_PLUGIN", sin, 1);
  try {
    const auto bound = make_user_shader(file, "bad.so")->bind(test::random_points(5, 1));
    Planes<3> out;
    bound->radiance_each(test::random_pairs(5, 1), out);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Plugin, HostileOnes_AreRefusedForWhatTheyAre) {
  const std::filesystem::path file = kFolder / "hostile.so";
  const auto expect = [&](const char* sin, const std::string& part) {
    const std::string found = complaint(file, sin);
    EXPECT_NE(found.find(part), std::string::npos) << sin << ": " << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  };
  EXPECT_EQ(complaint(file), "");
  expect("version", "expected a plug-in of version 1, found 99");
  expect("nothing", "expected redmap_plugin() to return a plug-in, found null");
  expect("null", "expected a declaration, bind and radiance");
  expect("size", "expected a pattern of 1 to 65536 bytes, found 0");
  expect("declaration", "hostile.so: declaration:2: parameter 'a' needs a comment");
  expect("nan", "shader \"bad.so\": radiance(): expected finite numbers, found nan, at position (");
  expect("normal", "shader \"bad.so\": shading_normal(): expected a unit vector, found one of length 0");
}

TEST(Plugin, FilesThatAreNone_AreNamed) {
  const TemporaryFolder folder;
  EXPECT_NE(complaint(folder / "missing.so").find("missing.so: expected a shared library"), std::string::npos);
  write_file(folder / "text.so", "no library");
  EXPECT_NE(complaint(folder / "text.so").find("text.so: expected a shared library"), std::string::npos);
  EXPECT_THROW(make_user_shader(kFolder / "candy.so", "candy.so", {{{"strips", {2}}}, {}, ""}), Error);
  EXPECT_THROW(make_user_shader(kFolder / "candy.so", "candy.so", {{}, {{"wood", {"wood.png", false}}}, ""}), Error);
}

}  // namespace
}  // namespace redmap
