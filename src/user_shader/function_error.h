// What a function of a user's shader did wrong, and where. Not part of the public interface.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/vec.h"

namespace redmap {

/// Something is wrong with what `function` does at entry `place` of a batch.
class FunctionError : public Error {
 public:
  FunctionError(std::size_t place, std::string_view function, const std::string& what)
      : Error("{}(): {}", function, what), place_(place) {}
  std::size_t place() const { return place_; }

 private:
  std::size_t place_;
};

/// Throw FunctionError at the first of `count` entries of `rows` that is not what it says.
void require_finite(std::span<float* const> rows, std::size_t count, std::string_view function);
void require_unit(std::span<float* const> rows, std::size_t count, std::string_view function);

/// Throws `error` as an Error that names the shader and the place.
[[noreturn]] void fail_at(const FunctionError& error, std::string_view shader, Vec3 position);

}  // namespace redmap
