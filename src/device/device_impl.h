// Vulkan handles behind device.h; not part of the public interface. The handles free themselves (vulkan_raii.hpp),
// except on a device that a timeout has left working: there they are kept until the process ends.
#pragma once

#define VK_NO_PROTOTYPES
#include <atomic>
#include <mutex>
#include <utility>
#include <vulkan/vulkan_raii.hpp>

#include "device/device.h"

namespace redmap {

/// The first complaint of a validation layer.
class ValidationLog {
 public:
  void add(const char* message);
  /// Throws what was complained about, if anything.
  void check();

 private:
  std::mutex mutex_;
  std::string first_;
};

/// Vulkan itself, and its complaints.
struct VulkanInstance {
  vk::raii::Context context;
  ValidationLog log;
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};

  static VulkanInstance& get();

 private:
  VulkanInstance();
};

struct Device::Impl {
  VulkanInstance& vulkan = VulkanInstance::get();
  DeviceInfo info;
  vk::raii::PhysicalDevice physical{nullptr};
  vk::PhysicalDeviceLimits limits;
  std::uint32_t queue_family = 0;
  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  std::mutex queue_mutex;
  std::atomic<bool> stuck = false;  ///< after a timeout

  /// Memory with `flags` for what has `requirements`, one with `preferred` too if there is any.
  vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags flags,
                                  vk::MemoryPropertyFlags preferred = {});
  /// Hands `commands` to the queue and waits.
  void submit(const vk::raii::CommandBuffer& commands, const vk::raii::Fence& fence, std::chrono::milliseconds timeout);
};

struct DeviceBuffer::Impl {
  std::shared_ptr<Device::Impl> device;
  std::size_t size = 0;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* data = nullptr;
};

struct DeviceImage::Impl {
  std::shared_ptr<Device::Impl> device;
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Image image{nullptr};
  vk::raii::ImageView view{nullptr};
  vk::raii::Sampler sampler{nullptr};
};

struct ComputePipeline::Impl {
  std::shared_ptr<Device::Impl> device;
  PipelineInputs inputs;
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
};

/// Keeps `handles` for ever.
void keep_until_exit(std::shared_ptr<void> handles);

/// What the destructors of device.h do: a stuck device may still use what would be freed.
template <typename Impl>
void free_or_keep(std::unique_ptr<Impl>& impl) {
  if (impl && impl->device->stuck) keep_until_exit(std::shared_ptr<Impl>(std::move(impl)));
}

/// Runs `body`; what Vulkan or its validation layer complain about becomes an Error that names the device.
template <typename Body>
auto on_device(Device::Impl& device, Body&& body) {
  const auto check = [&] {
    try {
      device.vulkan.log.check();
    } catch (const Error& error) {
      throw Error("device \"{}\": {}", device.info.name, error.what());
    }
  };
  try {
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      check();
    } else {
      auto result = body();
      check();
      return result;
    }
  } catch (const vk::SystemError& error) {
    check();
    throw Error("device \"{}\": {}", device.info.name, error.what());
  }
}

}  // namespace redmap
