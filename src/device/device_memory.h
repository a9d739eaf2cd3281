// Memory that stays on a device: buffers, stacks of pictures with their levels, and pictures that triangles are drawn
// into.
#pragma once

#include <span>

#include "base/extent.h"
#include "device/device.h"

namespace redmap {

/// Memory of the device itself. Shaders read and write it as a storage buffer, draws take vertices and indices from it.
/// The host copies in and out.
class LocalBuffer {
 public:
  /// At least one byte. Throws Error where the device has no buffers of that size.
  LocalBuffer(const Device& device, std::size_t size);
  /// Filled with `bytes`.
  LocalBuffer(const Device& device, std::span<const std::byte> bytes);
  ~LocalBuffer();
  LocalBuffer(LocalBuffer&&) noexcept;
  LocalBuffer& operator=(LocalBuffer&&) noexcept;

  std::size_t size() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

enum class TexelKind {
  kBytes,  ///< RGBA, 0 to 1
  kHalves  ///< RGBA, 16-bit floats
};

/// Layers of texels with their mip levels, each half the one before, rounded down and at least 1. Shaders sample it as
/// a sampler2DArray: linear within and between levels; v is clamped, u repeated or clamped.
class LayeredTexture {
 public:
  /// `texels`: level by level, layer by layer, row by row.
  LayeredTexture(const Device& device, TexelKind kind, Extent base, int layers, int levels, bool wraps_u,
                 std::span<const std::byte> texels);
  ~LayeredTexture();
  LayeredTexture(LayeredTexture&&) noexcept;
  LayeredTexture& operator=(LayeredTexture&&) noexcept;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// What triangles are drawn into, and shaders then fetch from.
enum class TargetKind {
  kNumbers,  ///< a whole number a pixel (usampler2DArray), nearest first: greater depth values are nearer
  kLayers,   ///< the same, and shaders fetch the depth values too (sampler2DArray)
  kDepth,    ///< the greatest depth value alone (sampler2DArray)
};

class RenderTarget {
 public:
  RenderTarget(const Device& device, TargetKind kind, Extent extent, int layers = 1);
  ~RenderTarget();
  RenderTarget(RenderTarget&&) noexcept;
  RenderTarget& operator=(RenderTarget&&) noexcept;

  Extent extent() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap
