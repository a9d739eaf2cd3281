// Work for a device, recorded step by step and handed over as a whole: triangles drawn into targets, compute shaders,
// copies. Each step sees all that those before it wrote.
#pragma once

#include "device/device_memory.h"

namespace redmap {

/// What the shaders of a draw are given: as compute shaders (PipelineInputs), for both stages. The vertex shader reads
/// positions (vec3) at location 0. Nothing is culled.
class GraphicsPipeline {
 public:
  GraphicsPipeline(const Device& device, std::span<const std::uint32_t> vertex_spirv,
                   std::span<const std::uint32_t> fragment_spirv, TargetKind kind, const PipelineInputs& inputs);
  ~GraphicsPipeline();
  GraphicsPipeline(GraphicsPipeline&&) noexcept;
  GraphicsPipeline& operator=(GraphicsPipeline&&) noexcept;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// What a pipeline's bindings are: buffers first, then pictures, in the order they are added. What is added must live
/// for as long as the bindings are used.
class Bindings {
 public:
  explicit Bindings(const ComputePipeline& pipeline);
  explicit Bindings(const GraphicsPipeline& pipeline);
  ~Bindings();
  Bindings(Bindings&&) noexcept;
  Bindings& operator=(Bindings&&) noexcept;

  Bindings& add(const LocalBuffer& buffer);
  Bindings& add(const DeviceBuffer& buffer);
  Bindings& add(const LayeredTexture& texture);
  Bindings& add(const DeviceImage& image);
  Bindings& add(const RenderTarget& target);
  /// The depth values of a target of kind kLayers.
  Bindings& add_depth(const RenderTarget& target);

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// Recorded anew for every use. Everything that it names must live until run() has returned.
class CommandList {
 public:
  explicit CommandList(const Device& device);
  ~CommandList();
  CommandList(CommandList&&) noexcept;
  CommandList& operator=(CommandList&&) noexcept;

  /// Draws between these two go into `layer` of `target`, which is cleared to 0.
  void begin_target(const RenderTarget& target, int layer = 0);
  void end_target();
  /// `triangles` triangles of `positions` (three floats each) by `indices`, three of 32 bits a triangle.
  void draw(const GraphicsPipeline& pipeline, const Bindings& bindings, std::span<const std::byte> push_constants,
            const LocalBuffer& positions, const LocalBuffer& indices, std::uint32_t triangles);

  void dispatch(const ComputePipeline& pipeline, const Bindings& bindings, std::span<const std::byte> push_constants,
                Workgroups groups);
  /// As many workgroups as the three numbers at `offset` bytes of `groups` say.
  void dispatch(const ComputePipeline& pipeline, const Bindings& bindings, std::span<const std::byte> push_constants,
                const LocalBuffer& groups, std::size_t offset);

  /// Every four bytes of `buffer` become `value`.
  void fill(const LocalBuffer& buffer, std::uint32_t value);
  /// The first `size` bytes.
  void copy(const DeviceBuffer& from, const LocalBuffer& to, std::size_t size);
  void copy(const LocalBuffer& from, const DeviceBuffer& to, std::size_t size);

  /// Hands over all that was recorded, waits for it, and starts anew. Throws DeviceTimeout when it takes longer than
  /// `timeout`, and Error where the device fails.
  void run(std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap
