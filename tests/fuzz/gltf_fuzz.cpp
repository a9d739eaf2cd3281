// Fuzzes glTF files.
#include "mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return redmap::fuzz::read_mesh_file("input.gltf", data, size);
}
