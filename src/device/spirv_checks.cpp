#include "device/spirv_checks.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "device/spirv_words.h"

namespace redmap {
namespace {

constexpr spv::Capability kCapabilities[] = {spv::CapabilityMatrix, spv::CapabilityShader, spv::CapabilityImageQuery,
                                             spv::CapabilityFloat64, spv::CapabilityInt64};

/// Sizes of types in bytes, without padding, and of the arrays that variables are or contain.
class ArraySizes {
 public:
  void add(std::span<const std::uint32_t> i) {
    switch (operation(i)) {
      case spv::OpTypeBool:
        sizes_[i[1]] = {4, false};
        break;
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        sizes_[i[1]] = {i[2] / 8.0, false};
        break;
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
        sizes_[i[1]] = {sizes_[i[2]].bytes * i[3], false};
        break;
      case spv::OpTypeArray:
        sizes_[i[1]] = {sizes_[i[2]].bytes * constants_[i[3]], true};
        break;
      case spv::OpTypeStruct:
        for (const std::uint32_t member : i.subspan(2)) {
          sizes_[i[1]].bytes += sizes_[member].bytes;
          sizes_[i[1]].has_array |= sizes_[member].has_array;
        }
        break;
      case spv::OpConstant:
      case spv::OpSpecConstant:
        constants_[i[2]] = i[3];
        break;
      case spv::OpTypePointer:
        pointees_[i[1]] = i[3];
        break;
      case spv::OpVariable:
        if (const Size size = sizes_[pointees_[i[1]]];
            size.has_array && (i[3] == spv::StorageClassFunction || i[3] == spv::StorageClassPrivate))
          total_ += size.bytes;
        break;
      default:
        break;
    }
  }
  double total() const { return total_; }

 private:
  struct Size {
    double bytes = 0;  // as large as people can write
    bool has_array = false;
  };
  std::map<std::uint32_t, Size> sizes_;
  std::map<std::uint32_t, double> constants_;
  std::map<std::uint32_t, std::uint32_t> pointees_;
  double total_ = 0;
};

}  // namespace

void check_spirv(std::span<const std::uint32_t> spirv) {
  ArraySizes arrays;
  for_each_instruction(spirv, [&](std::span<const std::uint32_t> i) {
    if (operation(i) == spv::OpCapability && std::ranges::count(kCapabilities, i[1]) == 0)
      throw Error("expected a shader that keeps to core GLSL 4.50, found one that needs SPIR-V capability {}", i[1]);
    arrays.add(i);
  });
  if (arrays.total() > kLargestArrays)
    throw Error("expected arrays of at most {} bytes in all, found {:g}", kLargestArrays, arrays.total());
}

WideNumbers wide_numbers(std::span<const std::uint32_t> spirv) {
  WideNumbers found;
  for_each_instruction(spirv, [&](std::span<const std::uint32_t> i) {
    if (operation(i) != spv::OpCapability) return;
    found.floats |= i[1] == spv::CapabilityFloat64, found.integers |= i[1] == spv::CapabilityInt64;
  });
  return found;
}

}  // namespace redmap
