// Reading declarations, and what malformed ones are told.
#include "shader/shader_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace redmap {
namespace {

using testing::HasSubstr;

constexpr const char* kText = R"(// A summary.
struct Parameters {
  float scale;  // 14 [0.1, 1000] 1/unit: cells per object unit
  vec3 paint;   // 0.1 0.2 0.3 [0, 1]: colour of the paint

  int octaves;  // 3 [1, 8]: how many
};
struct Pattern { float a; };
Pattern pattern(Surface at, Parameters p) { return Pattern(1.0); }
vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return vec3(m.a); }
/* vec3 emission(Pattern m) { return vec3(at.time); } */
// vec3 transmittance(Pattern m)
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    parse_shader_text(text, "folder/own.glsl");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ShaderText, ReadsParametersAndFunctions) {
  const ShaderInfo info = parse_shader_text(kText, "folder/own.glsl");
  EXPECT_EQ(info.name, "own");
  EXPECT_EQ(info.summary, "A summary.");
  ASSERT_EQ(info.parameters.size(), 3u);
  EXPECT_EQ(info.parameters[0].name, "scale");
  EXPECT_EQ(info.parameters[0].default_value, std::vector<float>{14});
  EXPECT_EQ(info.parameters[0].minimum, 0.1f);
  EXPECT_EQ(info.parameters[0].maximum, 1000);
  EXPECT_EQ(info.parameters[0].unit, "1/unit");
  EXPECT_EQ(info.parameters[0].meaning, "cells per object unit");
  EXPECT_EQ(info.parameters[1].default_value, (std::vector<float>{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(info.parameters[1].unit, "");
  EXPECT_EQ(info.parameters[2].type, "int");
  EXPECT_FALSE(info.black_box);
}

TEST(ShaderText, IgnoresWhatIsCommentedOut) {
  const ShaderInfo info = parse_shader_text(kText, "own.glsl");
  EXPECT_FALSE(info.emits || info.transmits || info.varies_in_time || info.has_material || info.perturbs_normals);
}

TEST(ShaderText, FindsOptionalFunctionsAndTime) {
  const ShaderInfo info = parse_shader_text(std::string(kText) + R"(
vec3 emission( Pattern m ) { return vec3(0.0); }
vec3 transmittance(in Pattern m) { return vec3(0.0); }
Material material(Pattern m) { return Material(vec3(0.0), vec3(0.0), 1.0, vec3(0.0)); }
vec3 shading_normal(Surface at, Parameters p) { return at.normal; }
float clock(Surface place) { return place.time; })",
                                            "own.glsl");
  EXPECT_TRUE(info.emits && info.transmits && info.varies_in_time && info.has_material && info.perturbs_normals);
}

TEST(ShaderText, OnlyTheTimeOfASurfaceMakesAShaderVaryInTime) {
  const auto varies = [](const std::string& function) {
    return parse_shader_text(kText + function + "\n", "own.glsl").varies_in_time;
  };
  EXPECT_FALSE(varies("struct Wave { float time; }; float f(Wave w) { return w.time; }"));
  EXPECT_TRUE(varies("float f(in Surface place) { return place.time; }"));
  EXPECT_TRUE(varies("Surface moved(Surface s) { return s; } float f(Surface s) { return moved(s).time; }"));
  EXPECT_TRUE(varies("float f() { Surface both[2]; return both[1].time; }"));
}

TEST(ShaderText, SurvivesWindowsLineEnds) {
  std::string text;
  for (const char* c = kText; *c; ++c) text += *c == '\n' ? "\r\n" : std::string(1, *c);
  EXPECT_EQ(parse_shader_text(text, "own.glsl").parameters.size(), 3u);
}

TEST(ShaderText, ErrorsNameFileLineAndWhatWasExpected) {
  EXPECT_THAT(error_of(replaced(kText, "// 14 [0.1, 1000] 1/unit: cells per object unit", "")),
              testing::AllOf(HasSubstr("own.glsl:3"), HasSubstr("scale"), HasSubstr("DEFAULT [MINIMUM, MAXIMUM]")));
  EXPECT_THAT(error_of(replaced(kText, "14 [", "fourteen [")),
              testing::AllOf(HasSubstr("own.glsl:3"), HasSubstr("fourteen")));
  EXPECT_THAT(error_of(replaced(kText, "14 [", "14000 [")), HasSubstr("outside its range"));
  EXPECT_THAT(error_of(replaced(kText, "14 [", "nan [")), HasSubstr("own.glsl:3"));
  EXPECT_THAT(error_of(replaced(kText, "[0.1, 1000]", "[1000, 0.1]")), HasSubstr("empty range"));
  EXPECT_THAT(error_of(replaced(kText, "0.1 0.2 0.3", "0.1 0.2")),
              testing::AllOf(HasSubstr("own.glsl:4"), HasSubstr("3 number(s), found 2")));
  EXPECT_THAT(error_of(replaced(kText, "vec3 paint", "mat4 paint")),
              testing::AllOf(HasSubstr("own.glsl:4"), HasSubstr("mat4")));
  EXPECT_THAT(error_of(replaced(kText, "vec3 paint;", "vec3 paint, varnish;")), HasSubstr("own.glsl:4"));
  EXPECT_THAT(error_of(replaced(kText, "int octaves", "int scale")), HasSubstr("declared twice"));
  EXPECT_THAT(error_of(replaced(kText, "struct Parameters", "struct Settings")), HasSubstr("struct Parameters"));
  EXPECT_THAT(error_of(replaced(kText, "vec3 radiance(Pattern", "vec3 shine(Pattern")), HasSubstr("radiance"));
  EXPECT_THAT(error_of(replaced(kText, "vec3 radiance(Pattern", "vec3 radiance(Surface")), HasSubstr("both"));
  EXPECT_THAT(error_of("// Only\nstruct Parameters {\n  float a;  // 1 [0, 1]: a\n"),
              testing::AllOf(HasSubstr("own.glsl:2"), HasSubstr("not closed")));
  EXPECT_THAT(error_of(""), HasSubstr("struct Parameters"));
  EXPECT_THAT(error_of("struct Parameters { float"), HasSubstr("own.glsl:1"));
}

TEST(ShaderText, SurvivesEveryTruncationAndVeryLongLines) {
  const std::string text = kText;
  for (std::size_t length = 0; length < text.size(); ++length) error_of(text.substr(0, length));
  error_of(text + std::string(1000000, ' ') + "// " + std::string(1000000, '['));
  EXPECT_THAT(error_of(replaced(kText, "14 [", std::string(1000000, '7') + " [")), HasSubstr("own.glsl:3"));
}

TEST(ResolveIncludes, ReplacesLinesAndStopsAtCircles) {
  const auto read = [](std::string_view name) -> std::string {
    return name == "a" ? "in a\n#include \"b\"\n" : name == "b" ? "in b\n" : "#include \"c\"\n";
  };
  EXPECT_EQ(resolve_includes("first\n#include \"a\"\n  # include \"b\"\nlast\n", read),
            "first\nin a\nin b\nin b\nlast\n");
  EXPECT_THROW(resolve_includes("#include \"c\"\n", read), Error);
}

}  // namespace
}  // namespace redmap
