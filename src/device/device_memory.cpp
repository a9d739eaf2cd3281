#include "device/device_memory.h"

#include <algorithm>
#include <cstring>

#include "device/memory_impl.h"

namespace redmap {
namespace {

using vk::ImageUsageFlagBits;

constexpr vk::Format kNumbers = vk::Format::eR32Uint;
constexpr vk::Format kDepth = vk::Format::eD32Sfloat;

/// Of a 2D image of `layers`, sampled by shaders.
vk::ImageCreateInfo image_info(vk::Format format, Extent extent, int layers, int levels, vk::ImageUsageFlags usage) {
  vk::ImageCreateInfo info({}, vk::ImageType::e2D, format);
  info.extent = vk::Extent3D(extent.width, extent.height, 1);
  info.mipLevels = levels, info.arrayLayers = layers;
  info.usage = usage | ImageUsageFlagBits::eSampled;
  return info;
}

void check_size(const Device& device, Extent extent, int layers) {
  const auto& limits = device.impl()->limits;
  const int largest = static_cast<int>(limits.maxImageDimension2D), most = static_cast<int>(limits.maxImageArrayLayers);
  if (extent.width > largest || extent.height > largest || layers > most)
    throw Error("device \"{}\": expected pictures of at most {} pixels a side in {} layers, found {}x{} in {}",
                device.info().name, largest, most, extent.width, extent.height, layers);
}

vk::ImageMemoryBarrier transition(vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
  const bool before = from == vk::ImageLayout::eUndefined;
  vk::ImageMemoryBarrier barrier(
      before ? vk::AccessFlags() : vk::AccessFlagBits::eTransferWrite,
      before ? vk::AccessFlags(vk::AccessFlagBits::eTransferWrite) : vk::AccessFlagBits::eShaderRead, from, to);
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, VK_REMAINING_MIP_LEVELS, 0,
                              VK_REMAINING_ARRAY_LAYERS};
  return barrier;
}

Extent level_extent(Extent base, int level) {
  return {std::max(1, base.width >> level), std::max(1, base.height >> level)};
}

std::vector<vk::BufferImageCopy> level_copies(Extent base, int layers, int levels, std::size_t texel_bytes) {
  std::vector<vk::BufferImageCopy> copies;
  std::size_t offset = 0;
  for (int level = 0; level < levels; ++level) {
    const Extent extent = level_extent(base, level);
    const vk::ImageSubresourceLayers part(vk::ImageAspectFlagBits::eColor, level, 0, layers);
    copies.emplace_back(offset, 0, 0, part, vk::Offset3D(), vk::Extent3D(extent.width, extent.height, 1));
    offset += texel_bytes * extent.width * extent.height * layers;
  }
  return copies;
}

}  // namespace

ImageHandles make_image(Device::Impl& device, const vk::ImageCreateInfo& info, vk::ImageAspectFlagBits aspect) {
  ImageHandles made;
  made.image = {device.device, info};
  made.memory = device.allocate(made.image.getMemoryRequirements(), {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
  made.image.bindMemory(*made.memory, 0);
  const vk::ImageSubresourceRange all(aspect, 0, info.mipLevels, 0, info.arrayLayers);
  made.view = {device.device,
               vk::ImageViewCreateInfo({}, *made.image, vk::ImageViewType::e2DArray, info.format, {}, all)};
  return made;
}

LocalBuffer::LocalBuffer(const Device& device, std::size_t size) : impl_(new Impl{device.impl()}) {
  impl_->size = std::max<std::size_t>((size + 3) / 4 * 4, 4);
  if (impl_->size > device.largest_buffer())
    throw Error("device \"{}\": expected a buffer of at most {} bytes, found {}", device.info().name,
                device.largest_buffer(), size);
  on_device(*impl_->device, [&] {
    using Usage = vk::BufferUsageFlagBits;
    const auto usage = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst | Usage::eVertexBuffer |
                       Usage::eIndexBuffer | Usage::eIndirectBuffer;
    impl_->buffer = {impl_->device->device, vk::BufferCreateInfo({}, impl_->size, usage)};
    impl_->memory =
        impl_->device->allocate(impl_->buffer.getMemoryRequirements(), {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
    impl_->buffer.bindMemory(*impl_->memory, 0);
  });
}

LocalBuffer::LocalBuffer(const Device& device, std::span<const std::byte> bytes) : LocalBuffer(device, bytes.size()) {
  if (bytes.empty()) return;
  DeviceBuffer staging(device, bytes.size());
  std::memcpy(staging.data(), bytes.data(), bytes.size());
  on_device(*impl_->device, [&] {
    run_once(*impl_->device, [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(*staging.impl().buffer, *impl_->buffer, vk::BufferCopy(0, 0, bytes.size()));
    });
  });
}

LocalBuffer::~LocalBuffer() { free_or_keep(impl_); }
LocalBuffer::LocalBuffer(LocalBuffer&&) noexcept = default;
LocalBuffer& LocalBuffer::operator=(LocalBuffer&&) noexcept = default;
std::size_t LocalBuffer::size() const { return impl_->size; }

LayeredTexture::LayeredTexture(const Device& device, TexelKind kind, Extent base, int layers, int levels, bool wraps_u,
                               std::span<const std::byte> texels)
    : impl_(new Impl) {
  impl_->device = device.impl();
  check_size(device, base, layers);
  const bool bytes = kind == TexelKind::kBytes;
  const vk::Format format = bytes ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR16G16B16A16Sfloat;
  DeviceBuffer staging(device, texels.size());
  std::memcpy(staging.data(), texels.data(), texels.size());
  on_device(*impl_->device, [&] {
    impl_->image =
        make_image(*impl_->device, image_info(format, base, layers, levels, ImageUsageFlagBits::eTransferDst),
                   vk::ImageAspectFlagBits::eColor);
    vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
    sampler.addressModeU = wraps_u ? vk::SamplerAddressMode::eRepeat : vk::SamplerAddressMode::eClampToEdge;
    sampler.addressModeV = vk::SamplerAddressMode::eClampToEdge;
    sampler.maxLod = static_cast<float>(levels);
    impl_->sampler = {impl_->device->device, sampler};
    run_once(*impl_->device, [&](const vk::raii::CommandBuffer& commands) {
      using Stage = vk::PipelineStageFlagBits;
      using Layout = vk::ImageLayout;
      const vk::Image image = *impl_->image.image;
      commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
                               transition(image, Layout::eUndefined, Layout::eTransferDstOptimal));
      commands.copyBufferToImage(*staging.impl().buffer, image, Layout::eTransferDstOptimal,
                                 level_copies(base, layers, levels, bytes ? 4 : 8));
      commands.pipelineBarrier(Stage::eTransfer, Stage::eAllCommands, {}, {}, {},
                               transition(image, Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal));
    });
  });
}

LayeredTexture::~LayeredTexture() { free_or_keep(impl_); }
LayeredTexture::LayeredTexture(LayeredTexture&&) noexcept = default;
LayeredTexture& LayeredTexture::operator=(LayeredTexture&&) noexcept = default;

vk::raii::RenderPass make_render_pass(const vk::raii::Device& device, TargetKind kind) {
  using Layout = vk::ImageLayout;
  const bool numbers = kind != TargetKind::kDepth;
  const auto attachment = [](vk::Format format, bool kept, Layout use, Layout after) {
    return vk::AttachmentDescription({}, format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eClear,
                                     kept ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
                                     vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                     Layout::eUndefined, kept ? after : use);
  };
  std::vector<vk::AttachmentDescription> attachments;
  if (numbers)
    attachments.push_back(attachment(kNumbers, true, Layout::eColorAttachmentOptimal, Layout::eShaderReadOnlyOptimal));
  attachments.push_back(attachment(kDepth, kind != TargetKind::kNumbers, Layout::eDepthStencilAttachmentOptimal,
                                   Layout::eShaderReadOnlyOptimal));
  const vk::AttachmentReference color(0, Layout::eColorAttachmentOptimal);
  const vk::AttachmentReference depth(numbers ? 1 : 0, Layout::eDepthStencilAttachmentOptimal);
  vk::SubpassDescription subpass;
  if (numbers) subpass.setColorAttachments(color);
  subpass.pDepthStencilAttachment = &depth;
  return {device, vk::RenderPassCreateInfo({}, attachments, subpass)};
}

RenderTarget::RenderTarget(const Device& device, TargetKind kind, Extent extent, int layers) : impl_(new Impl) {
  impl_->device = device.impl(), impl_->kind = kind, impl_->extent = extent;
  check_size(device, extent, layers);
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    impl_->pass = make_render_pass(vulkan, kind);
    impl_->depth =
        make_image(*impl_->device, image_info(kDepth, extent, layers, 1, ImageUsageFlagBits::eDepthStencilAttachment),
                   vk::ImageAspectFlagBits::eDepth);
    if (kind != TargetKind::kDepth)
      impl_->numbers =
          make_image(*impl_->device, image_info(kNumbers, extent, layers, 1, ImageUsageFlagBits::eColorAttachment),
                     vk::ImageAspectFlagBits::eColor);
    impl_->sampler = {vulkan, vk::SamplerCreateInfo({}, vk::Filter::eNearest, vk::Filter::eNearest)};
    for (int layer = 0; layer < layers; ++layer) {
      std::vector<vk::ImageView> views;
      const auto add = [&](const ImageHandles& image, vk::Format format, vk::ImageAspectFlagBits aspect) {
        const vk::ImageSubresourceRange part(aspect, 0, 1, layer, 1);
        impl_->layer_views.emplace_back(
            vulkan, vk::ImageViewCreateInfo({}, *image.image, vk::ImageViewType::e2D, format, {}, part));
        views.push_back(*impl_->layer_views.back());
      };
      if (kind != TargetKind::kDepth) add(impl_->numbers, kNumbers, vk::ImageAspectFlagBits::eColor);
      add(impl_->depth, kDepth, vk::ImageAspectFlagBits::eDepth);
      impl_->framebuffers.emplace_back(
          vulkan, vk::FramebufferCreateInfo({}, *impl_->pass, views, extent.width, extent.height, 1));
    }
  });
}

RenderTarget::~RenderTarget() { free_or_keep(impl_); }
RenderTarget::RenderTarget(RenderTarget&&) noexcept = default;
RenderTarget& RenderTarget::operator=(RenderTarget&&) noexcept = default;
Extent RenderTarget::extent() const { return impl_->extent; }

}  // namespace redmap
