// Pictures on a device.
#include <cstring>

#include "device/device_impl.h"

namespace redmap {
namespace {

constexpr vk::Format kFormat = vk::Format::eR32G32B32A32Sfloat;
/// Uploads are short; what takes longer has failed.
constexpr std::chrono::seconds kUploadTimeout{60};

void copy_texels(const Image& image, std::byte* to) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, to += 4 * sizeof(float)) {
      const Rgb c = image.rgb(x, image.height - 1 - y);
      const int alpha = image.channels == 2 ? 1 : image.channels == 4 ? 3 : -1;
      const float texel[4] = {c.r, c.g, c.b, alpha < 0 ? 1 : image.at(x, image.height - 1 - y, alpha)};
      std::memcpy(to, texel, sizeof texel);
    }
}

vk::ImageMemoryBarrier transition(vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
  vk::ImageMemoryBarrier barrier;
  barrier.oldLayout = from, barrier.newLayout = to;
  barrier.srcAccessMask = from == vk::ImageLayout::eUndefined ? vk::AccessFlags() : vk::AccessFlagBits::eTransferWrite;
  barrier.dstAccessMask =
      to == vk::ImageLayout::eTransferDstOptimal ? vk::AccessFlagBits::eTransferWrite : vk::AccessFlagBits::eShaderRead;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
  return barrier;
}

void upload(Device::Impl& device, vk::Image image, vk::Buffer texels, vk::Extent3D extent) {
  const vk::raii::CommandPool pool(device.device, vk::CommandPoolCreateInfo({}, device.queue_family));
  const vk::CommandBufferAllocateInfo buffers(*pool, vk::CommandBufferLevel::ePrimary, 1);
  const vk::raii::CommandBuffer commands = std::move(vk::raii::CommandBuffers(device.device, buffers).front());
  using Stage = vk::PipelineStageFlagBits;
  using Layout = vk::ImageLayout;
  commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  commands.pipelineBarrier(Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
                           transition(image, Layout::eUndefined, Layout::eTransferDstOptimal));
  const vk::ImageSubresourceLayers layers(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
  commands.copyBufferToImage(texels, image, Layout::eTransferDstOptimal,
                             vk::BufferImageCopy(0, 0, 0, layers, {}, extent));
  commands.pipelineBarrier(Stage::eTransfer, Stage::eComputeShader, {}, {}, {},
                           transition(image, Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal));
  commands.end();
  device.submit(commands, vk::raii::Fence(device.device, vk::FenceCreateInfo()), kUploadTimeout);
}

}  // namespace

DeviceImage::DeviceImage(const Device& device, const Image& image) : impl_(new Impl{device.impl()}) {
  const int largest = static_cast<int>(device.impl()->limits.maxImageDimension2D);
  if (image.width > largest || image.height > largest)
    throw Error("device \"{}\": expected pictures of at most {} pixels a side, found {}x{}", device.info().name,
                largest, image.width, image.height);
  DeviceBuffer texels(device, image.pixels() * 4 * sizeof(float));
  copy_texels(image, texels.data());
  on_device(*impl_->device, [&] {
    const vk::raii::Device& vulkan = impl_->device->device;
    const vk::Extent3D extent(image.width, image.height, 1);
    const auto usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
    impl_->image = {vulkan, vk::ImageCreateInfo({}, vk::ImageType::e2D, kFormat, extent, 1, 1,
                                                vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage)};
    impl_->memory =
        impl_->device->allocate(impl_->image.getMemoryRequirements(), {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
    impl_->image.bindMemory(*impl_->memory, 0);
    const vk::ImageSubresourceRange range(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    impl_->view = {vulkan, vk::ImageViewCreateInfo({}, *impl_->image, vk::ImageViewType::e2D, kFormat, {}, range)};
    vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear);
    impl_->sampler = {vulkan, sampler};
    upload(*impl_->device, *impl_->image, *texels.impl().buffer, extent);
  });
}

DeviceImage::~DeviceImage() { free_or_keep(impl_); }
DeviceImage::DeviceImage(DeviceImage&&) noexcept = default;
DeviceImage& DeviceImage::operator=(DeviceImage&&) noexcept = default;

}  // namespace redmap
