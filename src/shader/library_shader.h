// Turns the types and functions of a shader text, read as C++ through glsl.h, into a Shader: patterns are stored as
// blocks of eight lanes and evaluated a block at a time.
//
// Each text stands in its own namespace; its functions are found there through the types of their arguments.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>
#include <utility>

#include "base/lanes.h"
#include "shader/shader.h"

namespace redmap::library {

/// Eight directions or colours.
template <typename Vector>
struct LanePlanes {
  /// Components of lanes [i, i + kLanes).
  static Vector load(const Planes<3>& planes, std::size_t i) {
    return {lanes::load(planes[0] + i), lanes::load(planes[1] + i), lanes::load(planes[2] + i)};
  }
  static void store(Planes<3>& planes, std::size_t i, Vector v) {
    lanes::store(planes[0] + i, v.x), lanes::store(planes[1] + i, v.y), lanes::store(planes[2] + i, v.z);
  }
};

/// Direction pairs, kLanes at a time; `step` floats from one block to the next.
struct DirectionLanes {
  std::array<const float*, 3> to_light, to_viewer;
  std::size_t step;

  DirectionLanes(std::array<const float*, 3> light, std::array<const float*, 3> viewer, std::size_t step_)
      : to_light(light), to_viewer(viewer), step(step_) {}
  explicit DirectionLanes(const DirectionPairs& pairs)
      : to_light{pairs.to_light[0], pairs.to_light[1], pairs.to_light[2]},
        to_viewer{pairs.to_viewer[0], pairs.to_viewer[1], pairs.to_viewer[2]},
        step(kLanes) {}
};

/// One direction pair in all lanes.
class BroadcastPair {
 public:
  BroadcastPair(const DirectionPairs& pairs, std::size_t pair) {
    for (int c = 0; c < 3; ++c) {
      redmap::lanes::store(&to_light_[c][0], pairs.to_light[c][pair]);
      redmap::lanes::store(&to_viewer_[c][0], pairs.to_viewer[c][pair]);
    }
  }
  DirectionLanes lanes() const {
    return {{to_light_[0], to_light_[1], to_light_[2]}, {to_viewer_[0], to_viewer_[1], to_viewer_[2]}, 0};
  }

 private:
  alignas(64) float to_light_[3][kLanes], to_viewer_[3][kLanes];
};

/// A text in the split form: pattern() once a place, radiance(Pattern) in the shading frame.
template <typename Surface, typename Vector, typename Parameters, typename Pattern>
struct SplitForm {
  using Bound = Pattern;
  static Bound bind(const Surface& at, const Parameters& p) { return pattern(at, p); }
  static Vector evaluate(const Bound& m, const Parameters&, Vector to_light, Vector to_viewer) {
    return radiance(m, to_light, to_viewer);
  }
};

/// Whether a text declares shading_normal().
template <typename Surface, typename Parameters>
inline constexpr bool kPerturbsNormals = requires(const Surface& at, const Parameters& p) {
  shading_normal(at, p);
};

/// Whether a text declares shading_tangent().
template <typename Surface, typename Parameters>
inline constexpr bool kTurnsTangents = requires(const Surface& at, const Parameters& p) {
  shading_tangent(at, p);
};

template <typename Surface, typename Vector, typename Parameters>
Vector normal_of(const Surface& at, [[maybe_unused]] const Parameters& p) {
  if constexpr (kPerturbsNormals<Surface, Parameters>)
    return shading_normal(at, p);
  else
    return at.normal;
}
template <typename Surface, typename Vector, typename Parameters>
Vector tangent_of(const Surface& at, [[maybe_unused]] const Parameters& p) {
  if constexpr (kTurnsTangents<Surface, Parameters>)
    return shading_tangent(at, p);
  else
    return at.tangent;
}

/// A black box: what is bound is the place, and directions are rotated from its shading frame to object space.
template <typename Surface, typename Vector, typename Parameters>
struct BlackBoxForm {
  struct FramedPlace {
    Surface at;
    Vector normal, tangent;  ///< of the shading frame
  };
  static constexpr bool kFramed = kPerturbsNormals<Surface, Parameters> || kTurnsTangents<Surface, Parameters>;
  using Bound = std::conditional_t<kFramed, FramedPlace, Surface>;

  static Bound bind(const Surface& at, [[maybe_unused]] const Parameters& p) {
    if constexpr (kFramed) {
      const Vector normal = normal_of<Surface, Vector>(at, p), tangent = tangent_of<Surface, Vector>(at, p);
      const Vector along = tangent - normal * dot(normal, tangent);
      // The little of the other normal counts only where the tangent is the shading normal.
      return {at, normal, normalize(along + at.normal * 1e-6f)};
    } else {
      return at;
    }
  }
  static Vector evaluate(const Bound& bound, const Parameters& p, Vector to_light, Vector to_viewer) {
    const Vector bitangent = cross(bound.normal, bound.tangent);
    const auto to_object = [&](Vector v) { return bound.tangent * v.x + bitangent * v.y + bound.normal * v.z; };
    if constexpr (kFramed)
      return radiance(bound.at, p, to_object(to_light), to_object(to_viewer));
    else
      return radiance(bound, p, to_object(to_light), to_object(to_viewer));
  }
};

/// All lanes of a block set to its lane `lane`. Every member of Block is a whole number of registers.
template <typename Block>
Block broadcast_lane(const Block& block, std::size_t lane) {
  static_assert(std::is_trivially_copyable_v<Block> && sizeof(Block) % sizeof(lanes::UintRegister) == 0);
  constexpr std::size_t kRegisters = sizeof(Block) / sizeof(lanes::UintRegister);
  lanes::UintRegister registers[kRegisters];
  std::memcpy(registers, &block, sizeof block);
  for (lanes::UintRegister& r : registers) r = lanes::UintRegister{} + r[lane];
  Block result;
  std::memcpy(&result, registers, sizeof result);
  return result;
}

/// The struct Parameters of a text with the same values in all lanes; its members stand in the order of `values`.
template <typename Parameters>
Parameters broadcast_parameters(const ShaderInfo& info, const ParameterValues& values) {
  constexpr std::size_t kRegisters = sizeof(Parameters) / sizeof(lanes::FloatRegister);
  lanes::FloatRegister registers[kRegisters] = {};
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const float value : values[i]) {
      assert(next < kRegisters);
      const bool is_int = info.parameters[i].type == "int";
      registers[next++] = is_int ? (lanes::FloatRegister)lanes::Int(static_cast<int>(value)).v : lanes::Float(value).v;
    }
  assert(next == kRegisters);
  Parameters result;
  std::memcpy(&result, registers, sizeof result);
  return result;
}

/// The optional functions of a text; without them a shader is opaque and dark.
template <typename Vector, typename Bound>
Vector transmittance_or_zero(const Bound& m) {
  if constexpr (requires { transmittance(m); })
    return transmittance(m);
  else
    return Vector(lanes::Float(0.0f));
}
template <typename Vector, typename Bound>
Vector emission_or_zero(const Bound& m) {
  if constexpr (requires { emission(m); })
    return emission(m);
  else
    return Vector(lanes::Float(0.0f));
}
template <typename Vector, typename Bound>
bool store_materials(const LaneVector<Bound>& blocks, std::size_t size, Materials& out) {
  if constexpr (requires { material(blocks[0]); }) {
    out.resize(size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto m = material(blocks[b]);
      LanePlanes<Vector>::store(out.diffuse, b * kLanes, m.diffuse);
      LanePlanes<Vector>::store(out.specular, b * kLanes, m.specular);
      LanePlanes<Vector>::store(out.transmittance, b * kLanes, m.transmittance);
      LanePlanes<Vector>::store(out.roughness, b * kLanes, m.roughness);
      lanes::store(out.exponent[0] + b * kLanes, m.exponent);
      lanes::store(out.ggx[0] + b * kLanes, m.ggx);
      lanes::store(out.grazing[0] + b * kLanes, m.grazing);
    }
    return true;
  } else {
    return false;
  }
}

template <typename Form, typename Vector, typename Parameters>
class LibraryPatterns final : public BoundPatterns {
 public:
  using Bound = typename Form::Bound;
  using Lanes = LanePlanes<Vector>;

  LibraryPatterns(std::size_t size, const Parameters& parameters)
      : size_(size), parameters_(parameters), blocks_(padded(size) / kLanes) {}
  Bound& block(std::size_t i) { return blocks_[i]; }
  /// Of eight patterns from `i` on, which must be done for all or for none.
  void set_shading_normals(std::size_t i, Vector normal) { store(normals_, i, normal); }
  void set_shading_tangents(std::size_t i, Vector tangent) { store(tangents_, i, tangent); }
  std::size_t size() const override { return size_; }

  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    assert(pairs.size() == size_);
    out.resize(size_);
    evaluate(blocks_.data(), 1, DirectionLanes(pairs), {out[0], out[1], out[2]}, blocks_.size());
  }

  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    assert(pattern < size_);
    out.resize(pairs.size());
    const Bound bound = broadcast_lane(blocks_[pattern / kLanes], pattern % kLanes);
    evaluate(&bound, 0, DirectionLanes(pairs), {out[0], out[1], out[2]}, padded(pairs.size()) / kLanes);
  }

  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size_);
    out.resize(pairs.size() * 3 * stride);
    // Runs of blocks that stay in the first-level cache while every pair visits them.
    constexpr std::size_t kRun = std::max<std::size_t>(1, 16384 / sizeof(Bound));
    for (std::size_t b = 0; b < blocks_.size(); b += kRun)
      for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
        const BroadcastPair directions(pairs, pair);
        float* to = out.data() + pair * 3 * stride + b * kLanes;
        evaluate(&blocks_[b], 1, directions.lanes(), {to, to + stride, to + 2 * stride},
                 std::min(kRun, blocks_.size() - b));
      }
  }

  void transmittance(Planes<3>& out) const override {
    out.resize(size_);
    for (std::size_t i = 0; i < size_; i += kLanes)
      Lanes::store(out, i, transmittance_or_zero<Vector>(blocks_[i / kLanes]));
  }

  void emission(Planes<3>& out) const override {
    out.resize(size_);
    for (std::size_t i = 0; i < size_; i += kLanes) Lanes::store(out, i, emission_or_zero<Vector>(blocks_[i / kLanes]));
  }

  bool materials(Materials& out) const override { return store_materials<Vector>(blocks_, size_, out); }
  bool shading_normals(Planes<3>& out) const override { return give(normals_, out); }
  bool shading_tangents(Planes<3>& out) const override { return give(tangents_, out); }

 private:
  void store(Planes<3>& to, std::size_t i, Vector v) {
    to.resize(size_);
    Lanes::store(to, i, v);
  }
  static bool give(const Planes<3>& from, Planes<3>& out) {
    if (from.size() == 0) return false;
    out = from;
    return true;
  }
  /// Radiance of `count` blocks in a row (step 1) or of one block again and again (step 0). The one place where
  /// radiance is compiled: otherwise each loop might contract multiplications and additions in its own way, and the
  /// three functions above would not agree bit for bit.
  [[gnu::noipa, gnu::flatten]] void evaluate(const Bound* bounds, std::size_t step, DirectionLanes directions,
                                             std::array<float*, 3> out, std::size_t count) const {
    const Parameters parameters = parameters_;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = i * directions.step;
      const auto load = [at](const std::array<const float*, 3>& from) {
        return Vector(lanes::load(from[0] + at), lanes::load(from[1] + at), lanes::load(from[2] + at));
      };
      const Vector value =
          Form::evaluate(bounds[i * step], parameters, load(directions.to_light), load(directions.to_viewer));
      lanes::store(out[0] + i * kLanes, value.x);
      lanes::store(out[1] + i * kLanes, value.y);
      lanes::store(out[2] + i * kLanes, value.z);
    }
  }

  std::size_t size_;
  Parameters parameters_;
  LaneVector<Bound> blocks_;
  Planes<3> normals_, tangents_;  ///< of shaders that declare them
};

template <typename Form, typename Surface, typename Vector, typename Parameters>
class LibraryShader final : public Shader {
 public:
  LibraryShader(const ShaderInfo& info, ParameterValues values)
      : info_(info), values_(std::move(values)), parameters_(broadcast_parameters<Parameters>(info_, values_)) {}
  const ShaderInfo& info() const override { return info_; }
  const ParameterValues& parameters() const override { return values_; }

  std::unique_ptr<BoundPatterns> bind(const SurfacePoints& points) const override {
    auto bound = std::make_unique<LibraryPatterns<Form, Vector, Parameters>>(points.size(), parameters_);
    for (std::size_t i = 0; i < points.size(); i += kLanes) {
      const Surface at = place(points, i);
      bound->block(i / kLanes) = bind_block(at);
      if constexpr (kPerturbsNormals<Surface, Parameters>)
        bound->set_shading_normals(i, shading_normal(at, parameters_));
      if constexpr (kTurnsTangents<Surface, Parameters>)
        bound->set_shading_tangents(i, normalize(shading_tangent(at, parameters_)));
    }
    return bound;
  }

 private:
  static Surface place(const SurfacePoints& points, std::size_t i) {
    using Lanes = LanePlanes<Vector>;
    Surface at;
    at.position = Lanes::load(points.position, i);
    at.normal = Lanes::load(points.normal, i);
    at.tangent = Lanes::load(points.tangent, i);
    at.uv = {lanes::load(points.uv[0] + i), lanes::load(points.uv[1] + i)};
    at.time = points.time;
    return at;
  }
  [[gnu::noinline]] typename Form::Bound bind_block(const Surface& at) const { return Form::bind(at, parameters_); }

  const ShaderInfo& info_;
  ParameterValues values_;
  Parameters parameters_;
};

}  // namespace redmap::library
