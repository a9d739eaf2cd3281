// Fuzzes reduction maps: what is accepted can be described, and looked up.
#include "fuzz.h"
#include "map/map_description.h"
#include "map/map_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace redmap;
  static fuzz::InputFile file("input.exr");
  return fuzz::expect_result_or_error([&] {
    const ReductionMap map = read_map(file.holding(data, size));
    describe_map(map);
    const Footprint footprint{{0.99f, 0.5f}, {0.2f, 0.01f}, {0, 0.3f}};
    map.weights.lookup(footprint);
    if (map.normals.empty()) return;
    NormalMixtures mixtures = NormalMixtures::none(map.basis.size());
    map.normals.gather({&footprint, 1}, map.weights, 2, mixtures);
  });
}
