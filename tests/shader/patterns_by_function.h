// Patterns in the tests of whoever binds shaders: one function says the radiance of each under each pair of directions.
#pragma once

#include "shader/shader.h"

namespace redmap {

class PatternsByFunction : public BoundPatterns {
 public:
  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(size());
    for (std::size_t i = 0; i < size(); ++i) out.set(i, radiance(i, pairs, i));
  }
  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) out.set(i, radiance(pattern, pairs, i));
  }
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size());
    out.assign(pairs.size() * 3 * stride, 0.0f);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (std::size_t i = 0; i < size(); ++i)
        for (int c = 0; c < 3; ++c) out[(p * 3 + c) * stride + i] = radiance(i, pairs, p)[c];
  }
  void transmittance(Planes<3>& out) const override { out = Planes<3>(size()); }
  void emission(Planes<3>& out) const override { out = Planes<3>(size()); }
  bool materials(Materials&) const override { return false; }

 private:
  virtual Vec3 radiance(std::size_t pattern, const DirectionPairs& pairs, std::size_t pair) const = 0;
};

}  // namespace redmap
