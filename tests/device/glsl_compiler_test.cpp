#include "device/glsl_compiler.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace redmap {
namespace {

std::string complaint(const std::string& text) {
  const std::string names[] = {"first.glsl", "second.glsl"};
  try {
    compile_glsl(text, names);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GlslCompiler, AcceptsAComputeShader) { EXPECT_EQ(complaint("#version 450\nvoid main() {}\n"), ""); }

TEST(GlslCompiler, NamesFileLineAndColumnOfTheFirstMistake) {
  EXPECT_EQ(complaint("#version 450\nvoid main() { float x = foo + food; }\n"),
            "first.glsl:2:25: 'foo': undeclared identifier");
  EXPECT_EQ(complaint("#version 450\nvoid main() {}\n#line 40 1\n\nfloat f() { return nofoo(3) + foo; }\n"),
            "second.glsl:41:20: 'nofoo': no matching overloaded function found");
  EXPECT_EQ(complaint("#version 450\nvoid main() {}\n#line 7 1\n  float f( { return 1.0; }\n"),
            "second.glsl:7:3: syntax error, unexpected LEFT_BRACE, expecting RIGHT_PAREN");
}

TEST(GlslCompiler, FindsTheWordAndNotWhatContainsIt) {
  EXPECT_EQ(complaint("#version 450\nvoid main() { float xy = 1.0; float z = xy + x; }\n").substr(0, 16),
            "first.glsl:2:46:");
}

TEST(GlslCompiler, TextWithoutAnEntryPoint_IsRefused) { EXPECT_NE(complaint("#version 450\nfloat x;\n"), ""); }

}  // namespace
}  // namespace redmap
