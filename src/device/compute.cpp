// Buffers, pipelines, and running them.
#include <algorithm>
#include <cstring>

#include "device/device_impl.h"
#include "device/spirv_checks.h"

namespace redmap {
namespace {

vk::DescriptorType type_of(const PipelineInputs& inputs, int binding) {
  if (binding < inputs.buffers) return vk::DescriptorType::eStorageBuffer;
  if (binding < inputs.buffers + inputs.images) return vk::DescriptorType::eCombinedImageSampler;
  return vk::DescriptorType::eUniformBuffer;
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, const PipelineInputs& inputs) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (int i = 0; i < inputs.buffers + inputs.images + inputs.uniforms; ++i)
    bindings.emplace_back(i, type_of(inputs, i), 1, vk::ShaderStageFlagBits::eCompute);
  return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::DescriptorPool make_pool(const vk::raii::Device& device, const PipelineInputs& inputs) {
  std::vector<vk::DescriptorPoolSize> sizes;
  if (inputs.buffers > 0) sizes.emplace_back(vk::DescriptorType::eStorageBuffer, inputs.buffers);
  if (inputs.images > 0) sizes.emplace_back(vk::DescriptorType::eCombinedImageSampler, inputs.images);
  if (inputs.uniforms > 0) sizes.emplace_back(vk::DescriptorType::eUniformBuffer, inputs.uniforms);
  return {device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
}

}  // namespace

vk::raii::DeviceMemory Device::Impl::allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags flags,
                                              vk::MemoryPropertyFlags preferred) {
  const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  for (const vk::MemoryPropertyFlags wanted : {flags | preferred, flags})
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
      if ((requirements.memoryTypeBits >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
        return {device, vk::MemoryAllocateInfo(requirements.size, i)};
  throw Error("expected memory of the kind {}, found none", vk::to_string(flags));
}

void Device::Impl::submit(const vk::raii::CommandBuffer& commands, const vk::raii::Fence& fence,
                          std::chrono::milliseconds timeout) {
  if (stuck) throw Error("expected a device that is not busy for ever, found one after a timeout");
  {
    const std::scoped_lock lock(queue_mutex);
    queue.submit(vk::SubmitInfo({}, {}, *commands), *fence);
  }
  const std::uint64_t nanoseconds = std::chrono::nanoseconds(timeout).count();
  if (device.waitForFences(*fence, true, nanoseconds) == vk::Result::eTimeout) {
    stuck = true;
    throw DeviceTimeout(
        fmt::format("device \"{}\": expected an end within {} ms, found none", info.name, timeout.count()));
  }
  device.resetFences(*fence);
}

DeviceBuffer::DeviceBuffer(const Device& device, std::size_t size) : impl_(new Impl{device.impl()}) {
  impl_->size = std::max<std::size_t>(size, 1);
  if (impl_->size > device.largest_buffer())
    throw Error("device \"{}\": expected a buffer of at most {} bytes, found {}", device.info().name,
                device.largest_buffer(), size);
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    using Memory = vk::MemoryPropertyFlagBits;
    using Usage = vk::BufferUsageFlagBits;
    const auto usage = Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eTransferSrc | Usage::eTransferDst;
    impl_->buffer = {vulkan, vk::BufferCreateInfo({}, impl_->size, usage)};
    impl_->memory = impl_->device->allocate(impl_->buffer.getMemoryRequirements(),
                                            Memory::eHostVisible | Memory::eHostCoherent, Memory::eHostCached);
    impl_->buffer.bindMemory(*impl_->memory, 0);
    impl_->data = static_cast<std::byte*>(impl_->memory.mapMemory(0, VK_WHOLE_SIZE));
  });
}

DeviceBuffer::~DeviceBuffer() { free_or_keep(impl_); }
DeviceBuffer::DeviceBuffer(DeviceBuffer&&) noexcept = default;
DeviceBuffer& DeviceBuffer::operator=(DeviceBuffer&&) noexcept = default;
std::size_t DeviceBuffer::size() const { return impl_->size; }
std::byte* DeviceBuffer::data() { return impl_->data; }
const std::byte* DeviceBuffer::data() const { return impl_->data; }

ComputePipeline::ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv,
                                 const PipelineInputs& inputs, std::uint32_t stage)
    : impl_(new Impl{device.impl(), inputs}) {
  if (inputs.push_constant_bytes > device.impl()->limits.maxPushConstantsSize)
    throw Error("device \"{}\": expected at most {} bytes of push constants, found {}", device.info().name,
                device.impl()->limits.maxPushConstantsSize, inputs.push_constant_bytes);
  const WideNumbers wide = wide_numbers(spirv);
  const vk::PhysicalDeviceFeatures features = impl_->device->physical.getFeatures();
  if ((wide.floats && !features.shaderFloat64) || (wide.integers && !features.shaderInt64))
    throw Error("device \"{}\": expected a shader with numbers of 32 bits, found wider ones", device.info().name);
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    impl_->set_layout = make_set_layout(vulkan, inputs);
    const vk::PushConstantRange constants(vk::ShaderStageFlagBits::eCompute, 0,
                                          static_cast<std::uint32_t>(inputs.push_constant_bytes));
    vk::PipelineLayoutCreateInfo layout({}, *impl_->set_layout);
    if (constants.size > 0) layout.setPushConstantRanges(constants);
    impl_->layout = {vulkan, layout};

    const vk::raii::ShaderModule module(vulkan, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    impl_->device->vulkan.log.check();  // drivers may crash on what the layer found wrong
    const vk::SpecializationMapEntry entry(0, 0, sizeof stage);
    const vk::SpecializationInfo constant(1, &entry, sizeof stage, &stage);
    const vk::PipelineShaderStageCreateInfo code({}, vk::ShaderStageFlagBits::eCompute, *module, "main", &constant);
    impl_->pipeline = {vulkan, nullptr, vk::ComputePipelineCreateInfo({}, code, *impl_->layout)};
  });
}

ComputePipeline::~ComputePipeline() { free_or_keep(impl_); }
ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;

struct ComputeTask::Impl {
  std::shared_ptr<Device::Impl> device;
  const ComputePipeline::Impl* pipeline;
  vk::raii::DescriptorPool descriptors{nullptr};
  vk::raii::DescriptorSet set{nullptr};
  vk::raii::CommandPool command_pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
};

ComputeTask::ComputeTask(const ComputePipeline& pipeline) : impl_(new Impl{pipeline.impl().device, &pipeline.impl()}) {
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    impl_->descriptors = make_pool(vulkan, impl_->pipeline->inputs);
    const vk::DescriptorSetAllocateInfo sets(*impl_->descriptors, *impl_->pipeline->set_layout);
    impl_->set = std::move(vk::raii::DescriptorSets(vulkan, sets).front());
    using Pool = vk::CommandPoolCreateFlagBits;
    impl_->command_pool = {vulkan, vk::CommandPoolCreateInfo(Pool::eResetCommandBuffer, impl_->device->queue_family)};
    const vk::CommandBufferAllocateInfo buffers(*impl_->command_pool, vk::CommandBufferLevel::ePrimary, 1);
    impl_->commands = std::move(vk::raii::CommandBuffers(vulkan, buffers).front());
    impl_->fence = {vulkan, vk::FenceCreateInfo()};
  });
}

ComputeTask::~ComputeTask() { free_or_keep(impl_); }
ComputeTask::ComputeTask(ComputeTask&&) noexcept = default;
ComputeTask& ComputeTask::operator=(ComputeTask&&) noexcept = default;

void ComputeTask::bind(int binding, const DeviceBuffer& buffer) {
  const vk::DescriptorBufferInfo info(*buffer.impl().buffer, 0, VK_WHOLE_SIZE);
  const vk::WriteDescriptorSet write(*impl_->set, binding, 0, type_of(impl_->pipeline->inputs, binding), {}, info);
  impl_->device->device.updateDescriptorSets(write, {});
}

void ComputeTask::bind(int binding, const DeviceImage& image) {
  const vk::DescriptorImageInfo info(*image.impl().sampler, *image.impl().view,
                                     vk::ImageLayout::eShaderReadOnlyOptimal);
  const vk::WriteDescriptorSet write(*impl_->set, binding, 0, vk::DescriptorType::eCombinedImageSampler, info);
  impl_->device->device.updateDescriptorSets(write, {});
}

void ComputeTask::run(std::span<const std::byte> push_constants, Workgroups groups, std::chrono::milliseconds timeout) {
  on_device(*impl_->device, [&] {
    const vk::raii::CommandBuffer& commands = impl_->commands;
    using Stage = vk::PipelineStageFlagBits;
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *impl_->pipeline->pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *impl_->pipeline->layout, 0, *impl_->set, {});
    if (!push_constants.empty())
      commands.pushConstants<std::byte>(*impl_->pipeline->layout, vk::ShaderStageFlagBits::eCompute, 0, push_constants);
    commands.dispatch(groups.x, groups.y, 1);
    const vk::MemoryBarrier written(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(Stage::eComputeShader, Stage::eHost, {}, written, {}, {});
    commands.end();
    impl_->device->submit(commands, impl_->fence, timeout);
  });
}

}  // namespace redmap
