#include "user_shader/function_error.h"

#include <cmath>

namespace redmap {
namespace {

/// Of the length of a shading normal: what normalize() leaves, and a little for long chains of rotations.
constexpr float kUnitTolerance = 1e-3f;

}  // namespace

void require_finite(std::span<float* const> rows, std::size_t count, std::string_view function) {
  for (const float* row : rows)
    for (std::size_t i = 0; i < count; ++i)
      if (!std::isfinite(row[i]))
        throw FunctionError(i, function, fmt::format("expected finite numbers, found {}", row[i]));
}

void require_unit(std::span<float* const> rows, std::size_t count, std::string_view function) {
  for (std::size_t i = 0; i < count; ++i) {
    const float length_found = length(Vec3{rows[0][i], rows[1][i], rows[2][i]});
    if (!(std::abs(length_found - 1) < kUnitTolerance))
      throw FunctionError(i, function, fmt::format("expected a unit vector, found one of length {:g}", length_found));
  }
}

void fail_at(const FunctionError& error, std::string_view shader, Vec3 p) {
  throw Error("shader \"{}\": {}, at position ({:g}, {:g}, {:g}) in object space", shader, error.what(), p.x, p.y, p.z);
}

}  // namespace redmap
