// Vulkan devices for compute, without a window: real GPUs, and software Vulkan on machines that have none.
//
// Vulkan's loader is opened when the first device is asked for; whoever asks for none needs no Vulkan. Storage buffers
// are read and written with bounds checks where the device has them (robustBufferAccess). Where a validation layer is
// loaded (VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation), whatever it finds wrong is thrown as Error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace redmap {

struct DeviceInfo {
  int index = 0;  ///< among all devices, in Vulkan's order
  std::string name, driver;
  std::string vulkan_version;
  bool software = false;  ///< Vulkan on the CPU
};

/// All devices that can compute; none where Vulkan or its drivers are not installed.
std::vector<DeviceInfo> list_devices();

/// Work on a device did not end in time. It cannot be stopped: the device takes no more work in this process.
class DeviceTimeout : public Error {
 public:
  using Error::Error;
};

/// An open device. Everything made by it keeps it open. Safe to share between threads.
class Device {
 public:
  /// `choice` is an index, or part of a name in any case; empty: the first GPU, else the first device. What is open
  /// already is shared. Throws Error, naming all there are, where none fits.
  static std::shared_ptr<Device> open(const std::string& choice = "");
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const;
  /// Bytes of the largest storage buffer.
  std::size_t largest_buffer() const;
  /// Whether shaders may compute in 64 bits.
  bool has_doubles() const;

  struct Impl;
  const std::shared_ptr<Impl>& impl() const { return impl_; }

 private:
  explicit Device(const std::string& choice);
  std::shared_ptr<Impl> impl_;
};

/// Memory that shaders read and write as a storage buffer, or read as a uniform buffer, and that the host sees.
class DeviceBuffer {
 public:
  /// Throws Error where the device has no buffers of that size. At least one byte.
  DeviceBuffer(const Device& device, std::size_t size);
  ~DeviceBuffer();
  DeviceBuffer(DeviceBuffer&&) noexcept;
  DeviceBuffer& operator=(DeviceBuffer&&) noexcept;

  std::size_t size() const;
  std::byte* data();
  const std::byte* data() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// A picture that shaders sample: four channels of floats, bilinear, repeated beyond [0, 1], no mip levels.
class DeviceImage {
 public:
  /// Missing colour channels repeat the first (grey), missing alpha is 1. Row 0 is at v = 1, the picture's top.
  DeviceImage(const Device& device, const Image& image);
  ~DeviceImage();
  DeviceImage(DeviceImage&&) noexcept;
  DeviceImage& operator=(DeviceImage&&) noexcept;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// What a compute shader is given: storage buffers at bindings 0, 1, ... of set 0, then pictures, then uniform buffers
/// (16 kB at least), and one block of push constants.
struct PipelineInputs {
  int buffers = 0, images = 0;
  std::size_t push_constant_bytes = 0;
  int uniforms = 0;
};

/// A compute shader, ready to run. Safe to share between threads.
class ComputePipeline {
 public:
  /// `stage` is the value of specialization constant 0. Throws Error where the device does not take the shader.
  ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv, const PipelineInputs& inputs,
                  std::uint32_t stage = 0);
  ~ComputePipeline();
  ComputePipeline(ComputePipeline&&) noexcept;
  ComputePipeline& operator=(ComputePipeline&&) noexcept;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct Workgroups {
  std::uint32_t x = 1, y = 1;
};

/// What one thread needs to run pipelines, one after the other.
class ComputeTask {
 public:
  explicit ComputeTask(const ComputePipeline& pipeline);
  ~ComputeTask();
  ComputeTask(ComputeTask&&) noexcept;
  ComputeTask& operator=(ComputeTask&&) noexcept;

  /// Both must live until run() has returned.
  void bind(int binding, const DeviceBuffer& buffer);
  void bind(int binding, const DeviceImage& image);
  /// Runs x times y workgroups and waits for them. Throws DeviceTimeout when they need longer than `timeout`, and Error
  /// where the device fails.
  void run(std::span<const std::byte> push_constants, Workgroups groups, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap
