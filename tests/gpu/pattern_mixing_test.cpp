// What is mixed of a pattern; that mixed pictures are those of the CPU says parity_test.cpp.
#include "gpu/pattern_mixing.h"

#include <gtest/gtest.h>

namespace redmap {
namespace {

std::string blended(const std::string& text) { return blend_text({text, {"mine.glsl"}}); }

bool mentions(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(PatternMixing, EveryFloatIsBlended_WholeNumbersStay) {
  const std::string text = blended(
      "struct Coat { vec3 tint; int kind; };\n"
      "struct Pattern { Coat coats[2]; float a, b; bool is_wet; mat2 bump; };\n");
  for (const char* member : {"to.coats[0].tint +=", "to.coats[1].tint +=", "to.a +=", "to.b +=", "to.bump +="})
    EXPECT_TRUE(mentions(text, member)) << member;
  EXPECT_FALSE(mentions(text, "kind") || mentions(text, "is_wet"));
}

TEST(PatternMixing, WhatIsNotPlain_IsLeftAlone) {
  for (const char* text : {"struct Pattern { REAL a; };", "struct Pattern { float a[kCount]; };", "vec3 nothing;",
                           "struct Pattern {\n#ifdef A\n float a;\n#endif\n};", "struct Pattern { float a[999]; };",
                           "struct Pattern { int a; };", "struct Pattern { float a", "struct Pattern { float };",
                           "struct Pattern { float a; };\nstruct Pattern { vec3 b; };", "struct Pattern { double a; };",
                           "struct Pattern { highp float a; };"})
    EXPECT_EQ(blended(text), "") << text;
}

TEST(PatternMixing, OneCallAGroup) {
  const std::string text = mixing_text(std::vector<int>{0, 1, 0, 0});
  EXPECT_TRUE(mentions(text, "redmap_put(redmap_patterns[2], redmap_w[2], redmap_m.patterns[0]"));
  EXPECT_TRUE(mentions(text, "redmap_m.patterns[1] = redmap_patterns[1];"));
  EXPECT_TRUE(mentions(text, "radiance(redmap_m.patterns[1]"));
  EXPECT_FALSE(mentions(text, "radiance(redmap_m.patterns[2]"));
  EXPECT_FALSE(mentions(text, "REDMAP_MIXES_ALL"));
  EXPECT_TRUE(mentions(mixing_text(std::vector<int>{0, 0}), "REDMAP_MIXES_ALL"));
}

}  // namespace
}  // namespace redmap
