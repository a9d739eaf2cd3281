// What the renderer's shaders read, as they lay it out (kernels/view.glsl, object.glsl, frame.glsl). Not part of the
// public interface.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "base/vec.h"
#include "device/commands.h"

namespace redmap {

struct Vec4 {
  float x = 0, y = 0, z = 0, w = 0;
  Vec4() = default;
  Vec4(Vec3 v, float w_) : x(v.x), y(v.y), z(v.z), w(w_) {}
  Vec4(float x_, float y_, float z_, float w_) : x(x_), y(y_), z(z_), w(w_) {}
};
struct UVec4 {
  std::uint32_t x = 0, y = 0, z = 0, w = 0;
};

/// RedmapView.
struct ViewBlock {
  Vec4 eye, top_left, right, down, forward;
};

/// RedmapObject.
struct ObjectBlock {
  Vec4 axis_x, axis_y, axis_z, shape;
  UVec4 numbers;
  Vec4 map;
  std::array<Vec4, 6> scales;
  Vec4 limits;
};

/// Most lights of a scene.
inline constexpr int kMostLights = 64;

/// RedmapFrame.
struct FrameBlock {
  Vec4 eye, top_left, right, down, background;
  UVec4 picture;
  struct Light {
    Vec4 place, intensity;
  };
  std::array<Light, kMostLights> lights;
};

/// RedmapBand: push constants of sorting and shading.
struct BandCall {
  UVec4 blocks;
  std::uint32_t first_row = 0, rows = 0, filters = 0, draws = 0;
};

/// Words of RedmapLists before its samples.
inline constexpr int kListsHead = 16;

/// Storage buffers and pictures of all pipelines of an object, by binding; its shader's images follow.
enum ObjectBinding {
  kFrameBinding,
  kObjectBinding,
  kFacesBinding,
  kListsBinding,
  kRadianceBinding,
  kParametersBinding,
  kPatternsBinding,
  kDataBinding,
  kViewsBinding,
  kPathsBinding,
  kObjectBuffers,
  kSeenBinding = kObjectBuffers,
  kTexelsBinding,
  kShadowsBinding,
  kObjectBindings
};

/// What the host writes every frame and shaders read: a copy here, one there.
class SharedBytes {
 public:
  SharedBytes(const Device& device, std::size_t size) : here_(device, size), there_(device, size) {}
  template <typename T>
  void set(const T& value, std::size_t index = 0) {
    std::memcpy(here_.data() + index * sizeof(T), &value, sizeof(T));
  }
  void record_upload(CommandList& commands) const { commands.copy(here_, there_, here_.size()); }
  const LocalBuffer& buffer() const { return there_; }

 private:
  DeviceBuffer here_;
  LocalBuffer there_;
};

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace redmap
