// Vulkan handles behind device_memory.h and commands.h; not part of the public interface.
#pragma once

#include "device/commands.h"
#include "device/device_impl.h"

namespace redmap {

/// Copies to a device are short; what takes longer has failed.
inline constexpr std::chrono::seconds kCopyTimeout{60};

/// An image with its memory.
struct ImageHandles {
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Image image{nullptr};
  vk::raii::ImageView view{nullptr};  ///< of all of it
};
ImageHandles make_image(Device::Impl& device, const vk::ImageCreateInfo& info, vk::ImageAspectFlagBits aspect);

struct LocalBuffer::Impl {
  std::shared_ptr<Device::Impl> device;
  std::size_t size = 0;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
};

struct LayeredTexture::Impl {
  std::shared_ptr<Device::Impl> device;
  ImageHandles image;
  vk::raii::Sampler sampler{nullptr};
};

struct RenderTarget::Impl {
  std::shared_ptr<Device::Impl> device;
  TargetKind kind;
  Extent extent;
  ImageHandles numbers, depth;
  vk::raii::Sampler sampler{nullptr};
  vk::raii::RenderPass pass{nullptr};
  std::vector<vk::raii::ImageView> layer_views;
  std::vector<vk::raii::Framebuffer> framebuffers;  ///< one a layer
};
vk::raii::RenderPass make_render_pass(const vk::raii::Device& device, TargetKind kind);

struct GraphicsPipeline::Impl {
  std::shared_ptr<Device::Impl> device;
  PipelineInputs inputs;
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
};

struct Bindings::Impl {
  std::shared_ptr<Device::Impl> device;
  vk::raii::DescriptorPool pool{nullptr};
  vk::raii::DescriptorSet set{nullptr};
  std::uint32_t added = 0;
};

/// Records with `record` and runs it.
template <typename Record>
void run_once(Device::Impl& device, const Record& record) {
  const vk::raii::CommandPool pool(device.device, vk::CommandPoolCreateInfo({}, device.queue_family));
  const vk::CommandBufferAllocateInfo buffers(*pool, vk::CommandBufferLevel::ePrimary, 1);
  const vk::raii::CommandBuffer commands = std::move(vk::raii::CommandBuffers(device.device, buffers).front());
  commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  record(commands);
  commands.end();
  device.submit(commands, vk::raii::Fence(device.device, vk::FenceCreateInfo()), kCopyTimeout);
}

}  // namespace redmap
