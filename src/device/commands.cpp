#include "device/commands.h"

#include <array>

#include "device/memory_impl.h"
#include "device/spirv_checks.h"

namespace redmap {
namespace {

vk::DescriptorType type_of(const PipelineInputs& inputs, std::uint32_t binding) {
  return static_cast<int>(binding) < inputs.buffers ? vk::DescriptorType::eStorageBuffer
                                                    : vk::DescriptorType::eCombinedImageSampler;
}

constexpr vk::ShaderStageFlags kDrawStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

/// All of the state of a draw that nobody may change.
struct DrawState {
  vk::VertexInputBindingDescription vertices{0, 3 * sizeof(float), vk::VertexInputRate::eVertex};
  vk::VertexInputAttributeDescription position{0, 0, vk::Format::eR32G32B32Sfloat, 0};
  vk::PipelineVertexInputStateCreateInfo input{{}, vertices, position};
  vk::PipelineInputAssemblyStateCreateInfo assembly{{}, vk::PrimitiveTopology::eTriangleList};
  vk::PipelineViewportStateCreateInfo viewport{{}, 1, nullptr, 1, nullptr};
  vk::PipelineRasterizationStateCreateInfo raster;
  vk::PipelineMultisampleStateCreateInfo samples;
  vk::PipelineDepthStencilStateCreateInfo depth;
  vk::PipelineColorBlendAttachmentState channel;
  vk::PipelineColorBlendStateCreateInfo blend;
  std::array<vk::DynamicState, 2> dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  vk::PipelineDynamicStateCreateInfo dynamic{{}, dynamic_states};

  explicit DrawState(TargetKind kind) {
    raster.lineWidth = 1;
    depth.depthTestEnable = depth.depthWriteEnable = true;
    depth.depthCompareOp = vk::CompareOp::eGreater;
    channel.colorWriteMask = vk::ColorComponentFlagBits::eR;
    if (kind != TargetKind::kDepth) blend.setAttachments(channel);
  }
  DrawState(const DrawState&) = delete;
};

}  // namespace

GraphicsPipeline::GraphicsPipeline(const Device& device, std::span<const std::uint32_t> vertex_spirv,
                                   std::span<const std::uint32_t> fragment_spirv, TargetKind kind,
                                   const PipelineInputs& inputs)
    : impl_(new Impl{device.impl(), inputs}) {
  const auto family = impl_->device->physical.getQueueFamilyProperties()[impl_->device->queue_family];
  if (!(family.queueFlags & vk::QueueFlagBits::eGraphics) || !impl_->device->physical.getFeatures().geometryShader)
    throw Error("device \"{}\": expected one that draws and numbers triangles, found one that does not",
                device.info().name);
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (int i = 0; i < inputs.buffers + inputs.images; ++i)
      bindings.emplace_back(i, type_of(inputs, i), 1, kDrawStages);
    impl_->set_layout = {vulkan, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    const vk::PushConstantRange constants(kDrawStages, 0, static_cast<std::uint32_t>(inputs.push_constant_bytes));
    vk::PipelineLayoutCreateInfo layout({}, *impl_->set_layout);
    if (constants.size > 0) layout.setPushConstantRanges(constants);
    impl_->layout = {vulkan, layout};

    const auto module = [&](std::span<const std::uint32_t> spirv) {
      return vk::raii::ShaderModule(vulkan, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    };
    const vk::raii::ShaderModule vertex = module(vertex_spirv), fragment = module(fragment_spirv);
    const vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
                                                        {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}};
    const DrawState state(kind);
    const vk::raii::RenderPass pass = make_render_pass(vulkan, kind);
    const vk::GraphicsPipelineCreateInfo info({}, stages, &state.input, &state.assembly, nullptr, &state.viewport,
                                              &state.raster, &state.samples, &state.depth, &state.blend, &state.dynamic,
                                              *impl_->layout, *pass, 0);
    impl_->pipeline = {vulkan, nullptr, info};
  });
}

GraphicsPipeline::~GraphicsPipeline() { free_or_keep(impl_); }
GraphicsPipeline::GraphicsPipeline(GraphicsPipeline&&) noexcept = default;
GraphicsPipeline& GraphicsPipeline::operator=(GraphicsPipeline&&) noexcept = default;

namespace {

template <typename Pipeline>
std::unique_ptr<Bindings::Impl> make_bindings(const Pipeline& pipeline) {
  auto made = std::make_unique<Bindings::Impl>();
  made->device = pipeline.device;
  const PipelineInputs& inputs = pipeline.inputs;
  on_device(*made->device, [&] {
    const vk::raii::Device& vulkan = made->device->device;
    std::vector<vk::DescriptorPoolSize> sizes;
    if (inputs.buffers > 0) sizes.emplace_back(vk::DescriptorType::eStorageBuffer, inputs.buffers);
    if (inputs.images > 0) sizes.emplace_back(vk::DescriptorType::eCombinedImageSampler, inputs.images);
    made->pool = {vulkan, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    const vk::DescriptorSetAllocateInfo sets(*made->pool, *pipeline.set_layout);
    made->set = std::move(vk::raii::DescriptorSets(vulkan, sets).front());
  });
  return made;
}

void add_buffer(Bindings::Impl& to, vk::Buffer buffer) {
  const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
  const vk::WriteDescriptorSet write(*to.set, to.added++, 0, vk::DescriptorType::eStorageBuffer, {}, info);
  to.device->device.updateDescriptorSets(write, {});
}

void add_picture(Bindings::Impl& to, vk::Sampler sampler, vk::ImageView view) {
  const vk::DescriptorImageInfo info(sampler, view, vk::ImageLayout::eShaderReadOnlyOptimal);
  const vk::WriteDescriptorSet write(*to.set, to.added++, 0, vk::DescriptorType::eCombinedImageSampler, info);
  to.device->device.updateDescriptorSets(write, {});
}

}  // namespace

Bindings::Bindings(const ComputePipeline& pipeline) : impl_(make_bindings(pipeline.impl())) {}
Bindings::Bindings(const GraphicsPipeline& pipeline) : impl_(make_bindings(pipeline.impl())) {}
Bindings::~Bindings() { free_or_keep(impl_); }
Bindings::Bindings(Bindings&&) noexcept = default;
Bindings& Bindings::operator=(Bindings&&) noexcept = default;

Bindings& Bindings::add(const LocalBuffer& buffer) { return add_buffer(*impl_, *buffer.impl().buffer), *this; }
Bindings& Bindings::add(const DeviceBuffer& buffer) { return add_buffer(*impl_, *buffer.impl().buffer), *this; }
Bindings& Bindings::add(const LayeredTexture& texture) {
  return add_picture(*impl_, *texture.impl().sampler, *texture.impl().image.view), *this;
}
Bindings& Bindings::add(const DeviceImage& image) {
  return add_picture(*impl_, *image.impl().sampler, *image.impl().view), *this;
}
Bindings& Bindings::add(const RenderTarget& target) {
  const RenderTarget::Impl& impl = target.impl();
  const ImageHandles& image = impl.kind == TargetKind::kDepth ? impl.depth : impl.numbers;
  return add_picture(*impl_, *impl.sampler, *image.view), *this;
}
Bindings& Bindings::add_depth(const RenderTarget& target) {
  return add_picture(*impl_, *target.impl().sampler, *target.impl().depth.view), *this;
}

struct CommandList::Impl {
  std::shared_ptr<Device::Impl> device;
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
  bool recording = false;

  const vk::raii::CommandBuffer& begun() {
    if (!recording) commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    recording = true;
    return commands;
  }
  /// Whatever comes next waits for whatever came before.
  void end_step() const {
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const vk::MemoryBarrier all(Access::eMemoryWrite, Access::eMemoryRead | Access::eMemoryWrite);
    commands.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands | Stage::eHost, {}, all, {}, {});
  }
  void bind(const ComputePipeline::Impl& pipeline, const Bindings::Impl& bindings,
            std::span<const std::byte> push_constants) {
    begun().bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pipeline.layout, 0, *bindings.set, {});
    if (!push_constants.empty())
      commands.pushConstants<std::byte>(*pipeline.layout, vk::ShaderStageFlagBits::eCompute, 0, push_constants);
  }
  void copy(vk::Buffer from, vk::Buffer to, std::size_t size) {
    begun().copyBuffer(from, to, vk::BufferCopy(0, 0, size));
    end_step();
  }
};

CommandList::CommandList(const Device& device) : impl_(new Impl{device.impl()}) {
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    using Pool = vk::CommandPoolCreateFlagBits;
    impl_->pool = {vulkan, vk::CommandPoolCreateInfo(Pool::eResetCommandBuffer, impl_->device->queue_family)};
    const vk::CommandBufferAllocateInfo buffers(*impl_->pool, vk::CommandBufferLevel::ePrimary, 1);
    impl_->commands = std::move(vk::raii::CommandBuffers(vulkan, buffers).front());
    impl_->fence = {vulkan, vk::FenceCreateInfo()};
  });
}

CommandList::~CommandList() { free_or_keep(impl_); }
CommandList::CommandList(CommandList&&) noexcept = default;
CommandList& CommandList::operator=(CommandList&&) noexcept = default;

void CommandList::begin_target(const RenderTarget& target, int layer) {
  const RenderTarget::Impl& impl = target.impl();
  const vk::Extent2D extent(impl.extent.width, impl.extent.height);
  const vk::ClearValue cleared[2] = {};
  const std::uint32_t attachments = impl.kind == TargetKind::kDepth ? 1 : 2;
  const vk::RenderPassBeginInfo pass(*impl.pass, *impl.framebuffers[layer], {{}, extent}, attachments, cleared);
  const vk::raii::CommandBuffer& commands = impl_->begun();
  commands.beginRenderPass(pass, vk::SubpassContents::eInline);
  commands.setViewport(0,
                       vk::Viewport(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1));
  commands.setScissor(0, vk::Rect2D({}, extent));
}

void CommandList::end_target() {
  impl_->commands.endRenderPass();
  impl_->end_step();
}

void CommandList::draw(const GraphicsPipeline& pipeline, const Bindings& bindings,
                       std::span<const std::byte> push_constants, const LocalBuffer& positions,
                       const LocalBuffer& indices, std::uint32_t triangles) {
  const vk::raii::CommandBuffer& commands = impl_->commands;
  const GraphicsPipeline::Impl& draws = pipeline.impl();
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *draws.pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *draws.layout, 0, *bindings.impl().set, {});
  if (!push_constants.empty()) commands.pushConstants<std::byte>(*draws.layout, kDrawStages, 0, push_constants);
  commands.bindVertexBuffers(0, *positions.impl().buffer, vk::DeviceSize{0});
  commands.bindIndexBuffer(*indices.impl().buffer, 0, vk::IndexType::eUint32);
  commands.drawIndexed(3 * triangles, 1, 0, 0, 0);
}

void CommandList::dispatch(const ComputePipeline& pipeline, const Bindings& bindings,
                           std::span<const std::byte> push_constants, Workgroups groups) {
  impl_->bind(pipeline.impl(), bindings.impl(), push_constants);
  impl_->commands.dispatch(groups.x, groups.y, 1);
  impl_->end_step();
}

void CommandList::dispatch(const ComputePipeline& pipeline, const Bindings& bindings,
                           std::span<const std::byte> push_constants, const LocalBuffer& groups, std::size_t offset) {
  impl_->bind(pipeline.impl(), bindings.impl(), push_constants);
  impl_->commands.dispatchIndirect(*groups.impl().buffer, offset);
  impl_->end_step();
}

void CommandList::fill(const LocalBuffer& buffer, std::uint32_t value) {
  impl_->begun().fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, value);
  impl_->end_step();
}

void CommandList::copy(const DeviceBuffer& from, const LocalBuffer& to, std::size_t size) {
  impl_->copy(*from.impl().buffer, *to.impl().buffer, size);
}
void CommandList::copy(const LocalBuffer& from, const DeviceBuffer& to, std::size_t size) {
  impl_->copy(*from.impl().buffer, *to.impl().buffer, size);
}

void CommandList::run(std::chrono::milliseconds timeout) {
  on_device(*impl_->device, [&] {
    impl_->begun().end();
    impl_->recording = false;
    impl_->device->submit(impl_->commands, impl_->fence, timeout);
  });
}

}  // namespace redmap
