// The lanes' functions and noise against double precision, one value at a time.
#include <gtest/gtest.h>

#include <functional>

#include "shader_test_support.h"

// Last, since it gives GLSL's type names their meaning; plain numbers are `real` and `std::int32_t` from here on.
using real = float;
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
#include "shader/library/include/noise.glsl"
#include "shader/library/include/worley.glsl"
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

using glsl::Float;
using glsl::Vec3;

/// Largest error of `lanes` against `exact` over [low, high], relative to 1 + |exact|.
double largest_error(real low, real high, const std::function<Float(Float)>& lanes,
                     const std::function<double(double)>& exact) {
  double largest = 0;
  for (std::size_t i = 0; i < 4096; i += kLanes) {
    Float x;
    for (std::size_t l = 0; l < kLanes; ++l) x.v[l] = low + (high - low) * static_cast<real>(i + l) / 4095;
    const Float found = lanes(x);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double expected = exact(x.v[l]);
      largest = std::max(largest, std::abs(found.v[l] - expected) / (1 + std::abs(expected)));
    }
  }
  return largest;
}

TEST(Lanes, TranscendentalFunctionsAgreeWithDouble) {
  using D = double;
  EXPECT_LT(largest_error(
                -50, 50, [](Float x) { return sin(x); }, [](D x) { return std::sin(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                -50, 50, [](Float x) { return cos(x); }, [](D x) { return std::cos(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                -20, 20, [](Float x) { return exp(x); }, [](D x) { return std::exp(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                -20, 20, [](Float x) { return exp2(x); }, [](D x) { return std::exp2(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                1e-3f, 90, [](Float x) { return log(x); }, [](D x) { return std::log(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                1e-3f, 90, [](Float x) { return log2(x); }, [](D x) { return std::log2(x); }),
            4e-7);
  EXPECT_LT(largest_error(
                -9, 9, [](Float x) { return atan(x, 2.0f); }, [](D x) { return std::atan2(x, 2.0); }),
            4e-7);
  EXPECT_LT(largest_error(
                -9, 9, [](Float x) { return atan(x, -2.0f); }, [](D x) { return std::atan2(x, -2.0); }),
            4e-7);
}

TEST(Lanes, PowAgreesWithDouble_AlsoForNarrowLobes) {
  for (const real exponent : {0.3f, 1.0f, 5.0f, 40.0f, 400.0f, 1000.0f}) {
    const auto lanes = [&](Float x) { return pow(x, Float(exponent)); };
    const auto exact = [&](double x) { return std::pow(x, static_cast<double>(exponent)); };
    EXPECT_LT(largest_error(0, 1, lanes, exact), 3e-6) << exponent;
    if (exponent <= 40) {
      EXPECT_LT(largest_error(1, 4, lanes, exact), 1e-5) << exponent;
    }
  }
  EXPECT_EQ(pow(Float(0.0f), Float(3.0f)).v[0], 0);
  EXPECT_EQ(pow(Float(1.0f), Float(1000.0f)).v[0], 1);
  EXPECT_EQ(pow(Float(0.5f), Float(1000.0f)).v[0], 0);
}

TEST(Lanes, ExactFunctionsAreExact) {
  using D = double;
  EXPECT_EQ(largest_error(
                -9, 9, [](Float x) { return floor(x); }, [](D x) { return std::floor(x); }),
            0);
  EXPECT_EQ(largest_error(
                -9, 9, [](Float x) { return abs(x); }, [](D x) { return std::abs(x); }),
            0);
  EXPECT_EQ(largest_error(
                -9, 9, [](Float x) { return Float(glsl::Int(x)); }, [](D x) { return std::trunc(x); }),
            0);
  EXPECT_EQ(largest_error(
                -9, 9, [](Float x) { return glsl::sign(x); }, [](D x) { return x > 0   ? 1
                                                                               : x < 0 ? -1
                                                                                       : 0; }),
            0);
  EXPECT_EQ(largest_error(
                -9, 9, [](Float x) { return glsl::step(0.5f, x); }, [](D x) { return x < 0.5 ? 0 : 1; }),
            0);
  EXPECT_LT(largest_error(
                -9, 9, [](Float x) { return glsl::mod(x, 3.0f); }, [](D x) { return x - 3 * std::floor(x / 3); }),
            1e-6);
}

std::uint32_t hash_reference(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u;
  return h ^ h >> 15;
}

/// Gradient noise written the slow way: a weighted sum over the corners of the cell.
double noise_reference(double x, double y, double z) {
  const double p[3] = {x, y, z};
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::int32_t cell[3];
    double weight = 1, offset[3];
    for (unsigned a = 0; a < 3; ++a) {
      const unsigned high = corner >> a & 1;
      const double base = std::floor(p[a]), f = p[a] - base, u = f * f * f * (f * (f * 6 - 15) + 10);
      cell[a] = static_cast<std::int32_t>(base) + static_cast<std::int32_t>(high);
      offset[a] = f - high;
      weight *= high ? u : 1 - u;
    }
    const std::uint32_t h = hash_reference(cell[0], cell[1], cell[2]);
    for (unsigned a = 0; a < 3; ++a)
      sum += weight * offset[a] * (std::sqrt(2.0) * (2.0 * (h >> (10 * a) & 1023) / 1023.0 - 1.0));
  }
  return sum;
}

TEST(Noise, AgreesWithASlowDoubleImplementation) {
  Random random(1);
  double squares = 0;
  for (std::size_t i = 0; i < 2000; i += kLanes) {
    Float x, y, z;
    for (std::size_t l = 0; l < kLanes; ++l)
      x.v[l] = 40 * random.next_float() - 20, y.v[l] = 40 * random.next_float() - 20, z.v[l] = 9 * random.next_float();
    const Float found = text::gradient_noise(Vec3(x, y, z));
    for (std::size_t l = 0; l < kLanes; ++l) {
      EXPECT_NEAR(found.v[l], noise_reference(x.v[l], y.v[l], z.v[l]), 5e-6);
      squares += found.v[l] * found.v[l];
    }
  }
  // About as strong as Perlin's, which the shaders' thresholds were chosen for.
  EXPECT_NEAR(std::sqrt(squares / 2000), 0.28, 0.04);
}

TEST(Worley, AgreesWithASearchOf125Cells) {
  Random random(2);
  for (std::size_t sample = 0; sample < 200; ++sample) {
    const double p[3] = {9 * random.next_float() - 4.0, 9 * random.next_float() - 4.0, random.next_float() * 1.0};
    double nearest = 1e9;
    for (std::int32_t k = -2; k <= 2; ++k)
      for (std::int32_t j = -2; j <= 2; ++j)
        for (std::int32_t i = -2; i <= 2; ++i) {
          const std::int32_t cell[3] = {static_cast<std::int32_t>(std::floor(p[0])) + i,
                                        static_cast<std::int32_t>(std::floor(p[1])) + j,
                                        static_cast<std::int32_t>(std::floor(p[2])) + k};
          const std::uint32_t h = hash_reference(cell[0], cell[1], cell[2]);
          double distance2 = 0;
          for (unsigned a = 0; a < 3; ++a) {
            const double d = cell[a] + (h >> (10 * a) & 1023) / 1024.0 - p[a];
            distance2 += d * d;
          }
          nearest = std::min(nearest, distance2);
        }
    const text::Cells found = text::worley(
        Vec3(Float(static_cast<real>(p[0])), Float(static_cast<real>(p[1])), Float(static_cast<real>(p[2]))));
    EXPECT_NEAR(found.nearest.v[3], std::sqrt(nearest), 1e-5);
    EXPECT_GE(found.second.v[3], found.nearest.v[3]);
    EXPECT_TRUE(found.id.v[3] >= 0 && found.id.v[3] < 1);
  }
}

TEST(LanesDeathTest, BranchOnDifferingLanes_IsCaughtWhereAssertionsAre) {
  Float mixed(1.0f);
  mixed.v[3] = -1;
  EXPECT_DEBUG_DEATH(static_cast<void>(static_cast<decltype(true)>(mixed > 0.0f)), "differs between lanes");
}

}  // namespace
}  // namespace redmap
