// Points on a surface as the shaders want them: one array a coordinate, padded to whole lanes.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// Floats evaluated together everywhere in redmap: one 256-bit register.
inline constexpr std::size_t kLanes = 8;

/// `n` rounded up to whole lanes.
constexpr std::size_t padded(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

template <typename T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};
  LaneAllocator() = default;
  template <typename U>
  LaneAllocator(const LaneAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  friend bool operator==(const LaneAllocator&, const LaneAllocator&) { return true; }
};

/// A vector whose data can be loaded in aligned lanes.
template <typename T>
using LaneVector = std::vector<T, LaneAllocator<T>>;

/// `size()` vectors of N floats, one padded array a component. Padding holds zeros until written.
template <int N>
class Planes {
 public:
  Planes() = default;
  explicit Planes(std::size_t size) { resize(size); }
  void resize(std::size_t size) {
    size_ = size;
    stride_ = padded(size);
    data_.resize(N * stride_);
  }
  std::size_t size() const { return size_; }
  std::size_t stride() const { return stride_; }
  float* operator[](int component) { return data_.data() + component * stride_; }
  const float* operator[](int component) const { return data_.data() + component * stride_; }

  void set(std::size_t i, Vec3 v) requires(N == 3) { (*this)[0][i] = v.x, (*this)[1][i] = v.y, (*this)[2][i] = v.z; }
  Vec3 get(std::size_t i) const requires(N == 3) { return {(*this)[0][i], (*this)[1][i], (*this)[2][i]}; }
  Rgb rgb(std::size_t i) const requires(N == 3) { return {(*this)[0][i], (*this)[1][i], (*this)[2][i]}; }
  void set(std::size_t i, Vec2 v) requires(N == 2) { (*this)[0][i] = v.x, (*this)[1][i] = v.y; }

 private:
  std::size_t size_ = 0, stride_ = 0;
  LaneVector<float> data_;
};

/// Points on the surface at rest, object space. Normals and tangents are unit vectors, tangents perpendicular to the
/// normals; `uv` are the object's own texture coordinates; `time` in seconds is the same for all.
struct SurfacePoints {
  Planes<3> position, normal, tangent;
  Planes<2> uv;
  float time = 0;

  std::size_t size() const { return position.size(); }
  void resize(std::size_t size) { position.resize(size), normal.resize(size), tangent.resize(size), uv.resize(size); }
};

/// Points at `places`, anything with a position, normal, tangent and uv. Padding repeats the last, since shaders
/// evaluate it too.
template <typename Place>
SurfacePoints points_at(const std::vector<Place>& places) {
  SurfacePoints points;
  points.resize(places.size());
  for (std::size_t i = 0; i < points.position.stride(); ++i) {
    const Place& place = places[i < places.size() ? i : places.size() - 1];
    points.position.set(i, place.position), points.normal.set(i, place.normal);
    points.tangent.set(i, place.tangent), points.uv.set(i, place.uv);
  }
  return points;
}

}  // namespace redmap
