// Fuzzes the JSON of reduction maps, which libFuzzer would hardly reach through the EXR around it.
#include "fuzz.h"
#include "map/map_description.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return redmap::fuzz::expect_result_or_error(
      [&] { redmap::parse_map_description(redmap::fuzz::text_of(data, size), "map"); });
}
