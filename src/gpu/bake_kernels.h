// The compute shaders of bake_text.h for one shader on one device, and batches of points to run them on. Not part of
// the public interface.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/surface_points.h"
#include "device/device.h"
#include "gpu/bake_text.h"
#include "shader/shader.h"

namespace redmap {

class BakeKernels {
 public:
  BakeKernels(const Shader& shader, const std::string& device);

  const std::shared_ptr<Device>& device() const { return device_; }
  /// The shaders of bake_text.h.
  ComputePipeline keys(const SampledTexels& sampled) const;
  ComputePipeline weights(const SampledTexels& sampled, const ChosenBasis& basis) const;

  const DeviceBuffer& parameters() const { return parameters_; }
  const std::vector<DeviceImage>& images() const { return images_; }
  /// Most points of a batch.
  std::size_t batch_points() const { return device_->info().software ? kSoftwarePoints : kHardwarePoints; }

 private:
  static constexpr std::size_t kSoftwarePoints = 1 << 14;  ///< tuned on llvmpipe
  static constexpr std::size_t kHardwarePoints = 1 << 18;

  ComputePipeline compile(const ShaderSources& text) const;

  std::shared_ptr<Device> device_;
  ShaderInfo info_;
  DeviceShader shader_;
  DeviceBuffer parameters_;
  std::vector<DeviceImage> images_;
};

/// Points under texels, on the device, and what a shader makes of them.
class PointBatch {
 public:
  /// `known` as kBakeKnown; must live as long as the batch.
  PointBatch(const BakeKernels& kernels, const ComputePipeline& pipeline, const DeviceBuffer& known,
             std::size_t most_points, std::size_t out_words_per_point);

  void clear() { points_ = 0, texels_.clear(), first_.clear(); }
  /// `texel` of each point, which follow one another.
  void add(const SurfacePoints& points, std::span<const std::size_t> texel);
  std::size_t points() const { return points_; }
  /// Each once, and where their points begin.
  const std::vector<std::size_t>& texels() const { return texels_; }
  std::size_t first_point(std::size_t texel) const { return first_[texel]; }
  std::size_t points_of(std::size_t texel) const {
    return (texel + 1 < first_.size() ? first_[texel + 1] : points_) - first_[texel];
  }

  /// Runs the shader for `count` points or texels. Returns the first point of which something is wrong.
  std::optional<std::size_t> run(BakeCall call);
  const std::uint32_t* out() const { return reinterpret_cast<const std::uint32_t*>(out_.data()); }
  /// What the shader of key_text() put out for a point.
  std::uint64_t key(std::size_t i) const { return out()[2 * i] | static_cast<std::uint64_t>(out()[2 * i + 1]) << 32; }
  /// One of the points.
  ReflectancePlace place(std::size_t i) const;
  SurfacePoints point(std::size_t i) const;

 private:
  std::size_t points_ = 0;
  float time_ = 0;
  std::vector<std::size_t> texels_;
  std::vector<std::uint32_t> first_;
  DeviceBuffer places_, first_buffer_, out_, status_;
  ComputeTask task_;
};

}  // namespace redmap
