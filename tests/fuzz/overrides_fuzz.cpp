// Fuzzes what -D says.
#include "fuzz.h"
#include "scene/overrides.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace redmap;
  const std::string text(fuzz::text_of(data, size));
  return fuzz::expect_result_or_error([&] {
    toml::table scene = toml::parse("[object.ball]\nshader = 'noise'\nmap_size = 64\n");
    apply_overrides(scene, {&text, 1});
  });
}
