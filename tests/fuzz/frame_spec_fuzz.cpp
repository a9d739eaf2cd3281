// Fuzzes frame specifications and the patterns of frame names.
#include "fuzz.h"
#include "scene/frame_spec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace redmap;
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::expect_result_or_error([&] { frame_path(text, 7); });
  return fuzz::expect_result_or_error([&] {
    int before = -1;
    for (const int frame : parse_frames(text)) {
      if (frame <= before) __builtin_trap();
      before = frame;
    }
  });
}
