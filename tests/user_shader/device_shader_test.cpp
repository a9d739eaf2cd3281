// What a device is given of a shader.
#include "user_shader/device_shader.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/temporary_folder.h"
#include "user_shader/user_shader.h"

namespace redmap {
namespace {

TEST(DeviceShader, OfTheLibraryAndOfItsFile_HaveTheSameParameters) {
  const ParameterOverrides overrides{{"scale", {3}}, {"blue", {.25f, .5f, 1}}};
  const auto library = device_shader(*make_library_shader("noise", overrides));
  const auto file =
      device_shader(*make_user_shader(std::string(REDMAP_SHADERS) + "/noise.glsl", "n", {overrides, {}, ""}));
  ASSERT_TRUE(library && file);
  EXPECT_EQ(library->parameters, file->parameters);
  EXPECT_NE(library->sources.text.find("Pattern pattern(Surface at, Parameters p)"), std::string::npos);
}

TEST(DeviceShader, OfAPlugin_IsNone) {
  EXPECT_FALSE(device_shader(*make_user_shader(std::string(REDMAP_PLUGINS) + "/candy.so", "candy")));
}

TEST(DeviceShader, OfAFileThatHasChanged_IsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "mine.glsl";
  const std::string text =
      "// Mine.\nstruct Parameters {\n  float a;  // 1 [0, 1]: a\n};\nstruct Pattern { float b; };\n"
      "Pattern pattern(Surface at, Parameters p) { return Pattern(p.a); }\n"
      "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(m.b); }\n";
  std::ofstream(file) << text;
  const auto shader = make_user_shader(file, "mine.glsl");
  EXPECT_TRUE(device_shader(*shader));
  std::ofstream(file) << text << "// More.\n";
  EXPECT_THROW(device_shader(*shader), Error);
}

}  // namespace
}  // namespace redmap
