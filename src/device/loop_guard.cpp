// glslang begins every loop with a block of its own, `OpLabel, OpLoopMerge merge continue, OpBranch body`. It becomes
// `OpLabel, OpFunctionCall, OpLoopMerge merge continue, OpBranchConditional body merge`.
#include "device/loop_guard.h"

#include <utility>

#include "base/error.h"
#include "device/spirv_words.h"

namespace redmap {
namespace {

constexpr std::size_t kBound = 3;  ///< the word that holds the first unused id

std::uint32_t first_word(spv::Op op, std::size_t words) { return static_cast<std::uint32_t>(words << 16) | op; }

/// A function and its type.
struct Function {
  std::uint32_t id = 0, type = 0;
};

Function find_function(const std::vector<std::uint32_t>& spirv, const std::string& name) {
  Function found;
  for_each_instruction(spirv, [&](std::span<const std::uint32_t> i) {
    if (operation(i) == spv::OpName && reinterpret_cast<const char*>(&i[2]) == name + "(") found.id = i[1];
    if (operation(i) == spv::OpFunction && i[2] == found.id) found.type = i[1];
  });
  if (found.type == 0) throw Error("expected a function {}(), found none", name);
  return found;
}

/// Copies instructions, loops guarded.
class LoopGuard {
 public:
  LoopGuard(const std::vector<std::uint32_t>& spirv, Function guard)
      : guard_(guard), result_(spirv.begin(), spirv.begin() + kSpirvHeader) {}

  void add(std::span<const std::uint32_t> i) {
    const spv::Op op = operation(i);
    if (op == spv::OpFunction) return_type_ = i[1];
    if (op == spv::OpTypeVoid) void_type_ = i[1];
    if (op == spv::OpLoopMerge) {
      merge_ = i[1], answer_ = new_id();
      append({first_word(spv::OpFunctionCall, 4), guard_.type, answer_, guard_.id});
    }
    if (op == spv::OpBranch && merge_ != 0)
      append({first_word(spv::OpBranchConditional, 4), answer_, i[1], std::exchange(merge_, 0)});
    else if (op == spv::OpUnreachable)
      leave_function();
    else
      result_.insert(result_.end(), i.begin(), i.end());
  }
  std::vector<std::uint32_t> take() { return std::move(result_); }

 private:
  std::uint32_t new_id() { return result_[kBound]++; }
  void append(std::initializer_list<std::uint32_t> words) { result_.insert(result_.end(), words); }
  /// What follows `for (;;)` without a break can be reached now.
  void leave_function() {
    if (return_type_ == void_type_) return append({first_word(spv::OpReturn, 1)});
    const std::uint32_t value = new_id();
    append({first_word(spv::OpUndef, 3), return_type_, value, first_word(spv::OpReturnValue, 2), value});
  }

  Function guard_;
  std::vector<std::uint32_t> result_;
  std::uint32_t merge_ = 0, answer_ = 0;  ///< of the loop that has just begun
  std::uint32_t return_type_ = 0, void_type_ = 0;
};

}  // namespace

std::vector<std::uint32_t> guard_loops(const std::vector<std::uint32_t>& spirv, const std::string& guard) {
  LoopGuard copy(spirv, find_function(spirv, guard));
  for_each_instruction(spirv, [&](std::span<const std::uint32_t> instruction) { copy.add(instruction); });
  return copy.take();
}

}  // namespace redmap
