#include "user_shader/user_shader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/image.h"
#include "base/temporary_folder.h"
#include "shader/shader_test_support.h"

namespace redmap {
namespace {

const std::string kParameters = "struct Parameters {\n  float scale;  // 2 [0, 10]: a factor\n};\n";
const std::string kRest =
    "struct Pattern { vec3 colour; };\n"
    "vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return m.colour * to_light.z; }\n";
const std::string kPattern = "Pattern pattern(Surface at, Parameters p) { return Pattern(at.position * p.scale); }\n";

class UserShader : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    write_file(path, text);
    return path;
  }
  std::shared_ptr<const Shader> make(const std::string& text, const UserShaderSettings& settings = {}) {
    return make_user_shader(file("mine.glsl", text), "mine.glsl", settings);
  }
  /// What loading and running `text` complains about, without the folder; empty if nothing.
  std::string complaint(const std::string& text, const UserShaderSettings& settings = {}) {
    try {
      const auto bound = make(text, settings)->bind(points_);
      Planes<3> out;
      bound->radiance_each(pairs_, out);
      bound->transmittance(out), bound->emission(out);
    } catch (const Error& error) {
      std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      const std::string prefix = (folder_ / "").string();
      for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
      return message;
    }
    return "";
  }
  /// Radiance of `text` at the points under the pairs.
  Planes<3> radiance(const std::string& text, const UserShaderSettings& settings = {}) {
    Planes<3> out;
    make(text, settings)->bind(points_)->radiance_each(pairs_, out);
    return out;
  }

  TemporaryFolder folder_;
  SurfacePoints points_ = test::random_points(100, 1);
  DirectionPairs pairs_ = test::random_pairs(100, 2);
};

TEST_F(UserShader, ComputesWhatItsTextSays) {
  const Planes<3> found = radiance(kParameters + kRest + kPattern, {{{"scale", {3}}}, {}, ""});
  for (std::size_t i = 0; i < 100; ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(found[c][i], 3 * points_.position[c][i] * pairs_.to_light[2][i], 1e-5f) << i;
}

TEST_F(UserShader, ParametersOfEveryTypeArrive) {
  const std::string text = R"(
struct Parameters {
  float a;  // 1 [0, 10]: one
  vec3 b;   // 2 3 4 [0, 10]: three
  int c;    // 5 [0, 10]: whole
  vec2 d;   // 6 7 [0, 10]: two
  vec3 e;   // 8 9 10 [0, 10]: three
  float f;  // 0.5 [0, 10]: one
};
struct Pattern { bool right; };
Pattern pattern(Surface at, Parameters p) {
  return Pattern(p.a == 1.0 && p.b == vec3(2, 3, 4) && p.c == 5 && p.d == vec2(6, 7) && p.e == vec3(8, 9, 10) &&
                 p.f == 0.5);
}
vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return m.right ? vec3(1) : vec3(0); }
)";
  EXPECT_EQ(radiance(text)[0][50], 1);
}

// Swizzles, out parameters, matrices, branches, loops, arrays, structs in structs, bit operations, switch, recursion of
// macros: nothing that library texts may not have is missing.
TEST_F(UserShader, MayUseAllOfGlsl) {
  const std::string text = "#version 450\n" + kParameters + R"(
#define SQUARE(x) ((x) * (x))
struct Layer { mat3 turn; float heights[3]; };
struct Pattern { Layer layer; vec2 spots[2]; ivec3 cells; bvec2 flags; uint bits; };
const float kTable[4] = float[](0.1, 0.2, 0.3, 0.4);
void split(in vec3 p, out vec3 cell, inout float sum) { cell = floor(p); sum += fract(p).x; }
Pattern pattern(Surface at, Parameters p) {
  vec3 cell;
  float sum = 1.0;
  split(at.position.zxy * p.scale, cell, sum);
  Pattern m;
  m.layer.turn = mat3(1.0) * 2.0;
  for (int i = 0; i < 3; i++) m.layer.heights[i] = float(i) + sum;
  int k = 0;
  while (true) { if (++k > 5) break; if (k == 2) continue; }
  do k--; while (k > 3);
  switch (k) { case 3: m.bits = 0xF0u >> 4u; break; default: m.bits = 0u; }
  m.spots[0] = at.uv.yx, m.spots[1] = vec2(kTable[k & 3]);
  m.cells = ivec3(cell), m.flags = bvec2(sum >= 1.0, sum < 1.0);
  return m;
}
vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 turned = m.layer.turn * vec3(1.0);
  if (!all(equal(m.flags, bvec2(true, false)))) return vec3(0.0);
  return vec3(turned.x * SQUARE(2.0), float(bitCount(m.bits)), m.spots[1].x * (m.layer.heights[2] - m.layer.heights[0]));
}
)";
  const Planes<3> found = radiance(text);
  for (std::size_t i = 0; i < 100; ++i) {
    ASSERT_FLOAT_EQ(found[0][i], 8);
    ASSERT_FLOAT_EQ(found[1][i], 4);
    ASSERT_NEAR(found[2][i], 0.8f, 1e-6f);
  }
}

TEST_F(UserShader, IncludesTheLibraryAndFilesBesideIt) {
  file("parts/colour.glsl", "#include \"deeper.glsl\"\nvec3 colour() { return vec3(deeper()); }\n");
  file("parts/deeper.glsl", "float deeper() { return 0.25; }\n");
  const std::string text = "#include \"include/noise.glsl\"\n#include \"parts/colour.glsl\"\n" + kParameters + kRest +
                           "Pattern pattern(Surface at, Parameters p) {\n"
                           "  return Pattern(colour() + 0.0 * vec3(fbm(at.position, 8)));\n}\n";
  EXPECT_FLOAT_EQ(radiance(text)[0][3], 0.25f * pairs_.to_light[2][3]);
}

TEST_F(UserShader, SamplesItsImages_ColoursAsLinearLight_DataAsItIs) {
  Image grey(4, 4, 3, 0.5f);
  write_image(grey, folder_ / "grey.png");
  const std::string text = "uniform sampler2D colours;  // what is painted\n uniform sampler2D numbers;\n" +
                           kParameters +
                           "struct Pattern { vec2 c; };\n"
                           "Pattern pattern(Surface at, Parameters p) {\n"
                           "  return Pattern(vec2(texture(colours, at.uv).r, texture(numbers, at.uv).g));\n}\n"
                           "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(m.c, 0.0); }\n";
  const std::filesystem::path png = folder_ / "grey.png";
  const Planes<3> found = radiance(text, {{}, {{"colours", {png, false}}, {"numbers", {png, true}}}, ""});
  EXPECT_NEAR(found[0][9], 0.5f, 4e-3f);
  EXPECT_NEAR(found[1][9], 0.735f, 4e-3f);  // 0.5 in sRGB

  EXPECT_EQ(complaint(text), "shader \"mine.glsl\": expected a file for its image \"colours\", found none");
  EXPECT_EQ(complaint(kParameters + kRest + kPattern, {{}, {{"wood", {png, false}}}, ""}),
            "shader \"mine.glsl\": expected images to be none, found \"wood\"");
}

TEST_F(UserShader, HashChangesWithTextIncludesAndImages) {
  file("part.glsl", "float part() { return 1.0; }\n");
  const std::string text = "#include \"part.glsl\"\nuniform sampler2D wood;\n" + kParameters + kRest + kPattern;
  write_image(Image(2, 2, 3, 0.5f), folder_ / "a.png");
  write_image(Image(2, 2, 3, 0.6f), folder_ / "b.png");
  const auto hash = [&](const std::string& t, const char* image, bool is_data = false) {
    return make(t, {{}, {{"wood", {folder_ / image, is_data}}}, ""})->info().text_hash;
  };
  const std::uint64_t first = hash(text, "a.png");
  EXPECT_EQ(hash(text, "a.png"), first);
  EXPECT_NE(hash(text + "\n", "a.png"), first);
  EXPECT_NE(hash(text, "b.png"), first);
  EXPECT_NE(hash(text, "a.png", true), first);
  file("part.glsl", "float part() { return 2.0; }\n");
  EXPECT_NE(hash(text, "a.png"), first);
}

TEST_F(UserShader, MistakesAreNamedByFileLineAndColumn_ThroughIncludesToo) {
  EXPECT_EQ(
      complaint(kParameters + kRest + "Pattern pattern(Surface at, Parameters p) {\n  return Pattern(colour);\n}\n"),
      "mine.glsl:7:18: 'colour': undeclared identifier");
  file("part.glsl", "\n\nfloat part() { return whole; }\n");
  EXPECT_EQ(complaint("// A shader.\n#include \"part.glsl\"\n" + kParameters + kRest + kPattern),
            "part.glsl:3:23: 'whole': undeclared identifier");
  file("part.glsl", "float part() { return 1.0; }\n");
  EXPECT_EQ(complaint("// A shader.\n#include \"part.glsl\"\n" + kParameters + kRest + kPattern + "float x = ;\n")
                .substr(0, 26),
            "mine.glsl:9:1: syntax erro");
  EXPECT_EQ(complaint("#include \"missing.glsl\"\n" + kParameters + kRest + kPattern).substr(0, 86),
            "mine.glsl:1: include \"missing.glsl\": expected a file beside this one, or one of includ");
  EXPECT_EQ(complaint("#version 450\n" + std::string("struct Parameters {\n  float scale;\n};\n") + kRest + kPattern)
                .substr(0, 40),
            "mine.glsl:3: parameter 'scale' needs a c");
  file("loop.glsl", "#include \"loop.glsl\"\n");
  EXPECT_EQ(complaint("#include \"loop.glsl\"\n" + kParameters + kRest + kPattern),
            "loop.glsl:1: include \"loop.glsl\" leads back to itself");
}

TEST_F(UserShader, MissingOrWrongFunctions_AreNamed) {
  EXPECT_EQ(
      complaint(kParameters),
      "mine.glsl:1: expected 'Pattern pattern(Surface, Parameters)' or 'vec3 radiance(Surface, ...)', found neither");
  EXPECT_NE(complaint(kParameters + "struct Pattern { float a; };\n" + kPattern), "");
  const std::string wrong = complaint(kParameters + "struct Pattern { vec3 colour; };\n" + kPattern +
                                      "vec3 radiance(Pattern m, vec3 l) { return m.colour; }\n");
  EXPECT_EQ(wrong.substr(0, 30), "mine.glsl, as redmap calls it:") << wrong;
  EXPECT_NE(complaint(kParameters + kRest + kPattern + "void main() {}\n"), "");
}

TEST_F(UserShader, ReachingForMoreThanAShaderHas_IsRefused) {
  const auto with = [&](const std::string& line) { return complaint(kParameters + kRest + kPattern + line + "\n"); };
  EXPECT_EQ(with("vec2 f() { return gl_FragCoord.xy; }").substr(0, 33), "mine.glsl:7:19: 'gl_FragCoord': a");
  EXPECT_EQ(with("uniform float iTime;").substr(0, 27), "mine.glsl:7:1: 'uniform': a");
  EXPECT_EQ(with("buffer B { float secret[]; };").substr(0, 26), "mine.glsl:7:1: 'buffer': a");
  EXPECT_EQ(with("void f() { barrier(); }").substr(0, 29), "mine.glsl:7:12: 'barrier': a ");
  EXPECT_EQ(with("shared float s;").substr(0, 26), "mine.glsl:7:1: 'shared': a");
  EXPECT_EQ(with("/* gl_ and buffer\n may be said */ // uniform"), "");
}

TEST_F(UserShader, ScreenDerivatives_AreRefusedWithAdvice) {
  const std::string found = complaint(kParameters + kRest +
                                      "Pattern pattern(Surface at, Parameters p) {\n"
                                      "  float w = fwidth(at.uv.x);\n  return Pattern(vec3(w));\n}\n");
  EXPECT_EQ(found.substr(0, 25), "mine.glsl:7:13: 'fwidth':") << found;
  EXPECT_NE(found.find("no screen"), std::string::npos) << found;
}

TEST_F(UserShader, ThatDoesNotEnd_IsStoppedAndNamed) {
  const auto endless = [&](const std::string& body) {
    return complaint(kParameters + kRest + "float g(float x) { " + body + " }\n" +
                     "Pattern pattern(Surface at, Parameters p) { return Pattern(vec3(g(p.scale))); }\n");
  };
  const std::string expected =
      "shader \"mine.glsl\": pattern(): expected loops that end within 16384 rounds in all, found more";
  for (const char* body :
       {"while (x > 0.0) x += 1.0; return x;", "for (;;) { if (x < 0.0) return x; }",
        "for (int i = 0; i < 2; i *= 1) for (int j = 0; j < 9; j++) x++; return x;",
        "for (int i = 0; i < 300; i++) for (int j = 0; j < 300; j++) x += 0.5; return x;",
        "do { x += 1.0; if (x < 3.0) continue; } while (true); return x;", "while (true) {} return x;"})
    EXPECT_EQ(endless(body).substr(0, expected.size()), expected) << body;
  const std::string in_radiance = complaint(
      kParameters + "struct Pattern { vec3 c; };\n" + kPattern +
      "vec3 radiance(Pattern m, vec3 l, vec3 v) { float x = 0.0; while (l.z > -2.0) x += l.z; return vec3(x); }\n");
  EXPECT_EQ(in_radiance.substr(0, 40), "shader \"mine.glsl\": radiance(): expected");
}

TEST_F(UserShader, WithMoreThanADeviceCanBear_IsRefused) {
  const auto with = [&](const std::string& lines) {
    return complaint(lines + "\n" + kParameters + kRest +
                     "Pattern pattern(Surface at, Parameters p) { return Pattern(vec3(f(at.position.x))); }\n");
  };
  const std::string big =
      "float f(float x) { float a[SIZE]; for (int i = 0; i < 9; i++) a[int(x) + i] = x; return a[3]; }";
  EXPECT_EQ(with("#define SIZE 2000\n" + big), "");
  EXPECT_EQ(with("#define SIZE 200000000\n" + big),
            "mine.glsl: expected arrays of at most 32768 bytes in all, found 8e+08");
  EXPECT_EQ(with("#extension GL_KHR_shader_subgroup_arithmetic : require\nfloat f(float x) { return subgroupAdd(x); }")
                .substr(0, 58),
            "mine.glsl: expected a shader that keeps to core GLSL 4.50,");
  EXPECT_EQ(with("float f(float x) { double d = double(x); return float(d * d); }"), "");
}

// 3000 rounds for each of 34 pairs are too many for one invocation, and still end.
TEST_F(UserShader, WithLongLoops_IsNotTakenForEndless) {
  const auto bound = make(kParameters + "struct Pattern { vec3 c; };\n" + kPattern +
                          "vec3 radiance(Pattern m, vec3 l, vec3 v) {\n"
                          "  float x = 0.0; for (int i = 0; i < 3000; i++) x += l.z; return vec3(x); }\n")
                         ->bind(points_);
  const DirectionPairs pairs = test::random_pairs(34, 3);
  for (int repeat = 0; repeat < 2; ++repeat) {
    LaneVector<float> out;
    bound->radiance_all(pairs, out);
    for (std::size_t p = 0; p < 34; ++p) ASSERT_NEAR(out[p * 3 * padded(100) + 7], 3000 * pairs.to_light[2][p], 1) << p;
  }
}

TEST_F(UserShader, ThatReturnsNoNumbers_IsNamedWithFunctionAndPlace) {
  const std::string radiance_nan =
      complaint(kParameters + "struct Pattern { vec3 c; };\n" + kPattern +
                "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(sqrt(-abs(m.c.x) - 1.0)); }\n");
  EXPECT_EQ(radiance_nan.substr(0, 75),
            "shader \"mine.glsl\": radiance(): expected finite numbers, found " + radiance_nan.substr(63, 12));
  EXPECT_NE(radiance_nan.find("nan, at position ("), std::string::npos) << radiance_nan;
  const std::string infinite = complaint(kParameters + kRest + kPattern +
                                         "vec3 emission(Pattern m) { return vec3(1.0 / (m.colour.x * 0.0)); }\n");
  EXPECT_EQ(infinite.substr(0, 40), "shader \"mine.glsl\": emission(): expected") << infinite;
  const std::string normal = complaint(kParameters + kRest + kPattern +
                                       "vec3 shading_normal(Surface at, Parameters p) { return at.normal * 2.0; }\n");
  EXPECT_EQ(normal.substr(0, 83),
            "shader \"mine.glsl\": shading_normal(): expected a unit vector, found one of length 2");
}

TEST_F(UserShader, ReadingOutOfBounds_ReadsInBounds) {
  const std::string text = kParameters +
                           "struct Pattern { float a[3]; };\n"
                           "const float kValues[4] = float[](0.5, 0.5, 0.5, 0.5);\n"
                           "Pattern pattern(Surface at, Parameters p) {\n"
                           "  Pattern m; int far = int(at.position.x * 1e9);\n"
                           "  for (int i = 0; i < 3; i++) m.a[i] = kValues[far + i];\n"
                           "  m.a[far * 7] = kValues[far * 13];\n  return m;\n}\n"
                           "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(m.a[int(l.x * 1e9)]); }\n";
  const Planes<3> found = radiance(text);
  for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(found[1][i], 0.5f);
}

TEST_F(UserShader, BatchesLargerThanADispatch_AreWhole) {
  const SurfacePoints many = test::random_points(40000, 4);
  DirectionPairs one;
  one.resize(1);
  one.to_light.set(0, Vec3{0, 0, 1}), one.to_viewer.set(0, Vec3{0, 0, 1});
  LaneVector<float> out;
  make(kParameters + kRest + kPattern)->bind(many)->radiance_all(one, out);
  for (std::size_t i = 0; i < many.size(); ++i) ASSERT_NEAR(out[i], 2 * many.position[0][i], 1e-5f) << i;
}

}  // namespace
}  // namespace redmap
