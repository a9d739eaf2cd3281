// Fuzzes scene files. There is nothing beside them: meshes and shaders of the user's own are not found.
#include "fuzz.h"
#include "scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace redmap;
  static fuzz::InputFile file("input.toml");
  return fuzz::expect_result_or_error([&] {
    const SceneFile scene = SceneFile::load(file.holding(data, size));
    scene.at(scene.frame_count());
  });
}
