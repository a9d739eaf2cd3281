// Fuzzes the declarations of shader texts.
#include "fuzz.h"
#include "shader/shader_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace redmap;
  const std::string_view text = fuzz::text_of(data, size);
  const std::string name = "input.glsl";
  fuzz::expect_result_or_error([&] { parse_shader_text(text, name); });
  fuzz::expect_result_or_error([&] { parse_declaration(text, name); });
  fuzz::expect_result_or_error([&] { require_own_world(text, {&name, 1}); });
  return fuzz::expect_result_or_error([&] {
    // A text that includes itself, or anything else, which is empty.
    resolve_sources({name, std::string(text)},
                    [&](const std::string& included, const std::string&, const std::string&) {
                      return ShaderSource{included, included == name ? std::string(text) : ""};
                    });
  });
}
