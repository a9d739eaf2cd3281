// A map that `redmap export --to glsl` wrote, drawn by Vulkan 1.3 without a window: vulkan.frag includes redmap.glsl,
// and redmap_shade() does all the shading. Build: c++ -std=c++20 vulkan.cpp -lvulkan; usage: vulkan FOLDER
// MANIFEST_NUMBERS DISTANCE PIXELS OUT.pfm, the numbers being width height layers levels wraps_u rows vertices indices
// of manifest.json; the two .spv files lie in the current folder.
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Gpu {
  vk::raii::Context context;
  vk::ApplicationInfo application{"redmap", 1, nullptr, 0, VK_API_VERSION_1_3};
  vk::raii::Instance instance{context, vk::InstanceCreateInfo({}, &application)};
  vk::raii::PhysicalDevice physical = std::move(vk::raii::PhysicalDevices(instance).front());
  float priority = 1;
  vk::DeviceQueueCreateInfo queues{{}, 0, 1, &priority};
  vk::PhysicalDeviceVulkan13Features features;
  vk::raii::Device device{physical, chain()};
  vk::raii::CommandPool pool{device, {{}, 0}};
  vk::raii::CommandBuffer commands =
      std::move(vk::raii::CommandBuffers(device, {*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
  std::vector<vk::raii::DeviceMemory> memories;

  vk::DeviceCreateInfo chain() {
    features.dynamicRendering = true;
    return vk::DeviceCreateInfo().setQueueCreateInfos(queues).setPNext(&features);
  }
  template <typename Resource>
  void* bind(const Resource& resource, vk::MemoryPropertyFlags wanted) {
    const auto needs = resource.getMemoryRequirements();
    const auto all = physical.getMemoryProperties();
    std::uint32_t type = 0;
    while (!(needs.memoryTypeBits >> type & 1) || (all.memoryTypes[type].propertyFlags & wanted) != wanted) ++type;
    memories.emplace_back(device, vk::MemoryAllocateInfo(needs.size, type));
    resource.bindMemory(*memories.back(), 0);
    return wanted ? memories.back().mapMemory(0, VK_WHOLE_SIZE) : nullptr;
  }
  vk::raii::Buffer buffer(const std::string& bytes, vk::BufferUsageFlags usage, void** mapped = nullptr) {
    vk::raii::Buffer made(device, {{}, bytes.size(), usage});
    using Flag = vk::MemoryPropertyFlagBits;
    void* memory = bind(made, Flag::eHostVisible | Flag::eHostCoherent);
    std::memcpy(memory, bytes.data(), bytes.size());
    if (mapped) *mapped = memory;
    return made;
  }
  vk::raii::Image image(vk::Format format, std::uint32_t w, std::uint32_t h, std::uint32_t levels, std::uint32_t layers,
                        vk::ImageUsageFlags usage) {
    vk::raii::Image made(device, {{},
                                  vk::ImageType::e2D,
                                  format,
                                  {w, h, 1},
                                  levels,
                                  layers,
                                  vk::SampleCountFlagBits::e1,
                                  vk::ImageTiling::eOptimal,
                                  usage});
    bind(made, {});
    return made;
  }
  vk::raii::ImageView view(const vk::raii::Image& of, vk::ImageViewType type, vk::Format format,
                           vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor) {
    return {device, {{}, *of, type, format, {}, {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}}};
  }
  void change(const vk::raii::Image& of, vk::ImageLayout from, vk::ImageLayout to,
              vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor) {
    using Access = vk::AccessFlagBits;
    const auto all = Access::eMemoryRead | Access::eMemoryWrite;
    const vk::ImageMemoryBarrier barrier(all, all, from, to, 0, 0, *of,
                                         {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS});
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, {},
                             {}, barrier);
  }
};

int main(int, char** arguments) {
  const std::string folder = arguments[1];
  const auto number = [&](int i) { return std::uint32_t(std::stoi(arguments[2 + i])); };
  const std::uint32_t width = number(0), height = number(1), layers = number(2), levels = number(3), rows = number(5);
  const std::uint32_t pixels = number(9);
  const float eye = std::stof(arguments[10]);
  using Use = vk::ImageUsageFlagBits;
  using Layout = vk::ImageLayout;
  Gpu gpu;
  gpu.commands.begin({});

  // Weights: all levels, layer after layer, as they are in the file. Words: 2048 a row.
  const auto kBytes = vk::Format::eR8G8B8A8Unorm, kWords = vk::Format::eR32Uint,
             kFloats = vk::Format::eR32G32B32A32Sfloat;
  const auto weights = gpu.image(kBytes, width, height, levels, layers, Use::eSampled | Use::eTransferDst);
  const auto words = gpu.image(kWords, 2048, rows, 1, 1, Use::eSampled | Use::eTransferDst);
  const auto weight_bytes = gpu.buffer(read(folder + "/weights.bin"), vk::BufferUsageFlagBits::eTransferSrc);
  const auto word_bytes = gpu.buffer(read(folder + "/words.bin"), vk::BufferUsageFlagBits::eTransferSrc);
  std::vector<vk::BufferImageCopy> copies;
  for (std::uint32_t level = 0, at = 0; level < levels; ++level) {
    const std::uint32_t w = std::max(1u, width >> level), h = std::max(1u, height >> level);
    copies.push_back({at, 0, 0, {vk::ImageAspectFlagBits::eColor, level, 0, layers}, {}, {w, h, 1}});
    at += w * h * layers * 4;
  }
  const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {2048, rows, 1});
  for (const auto* image : {&weights, &words}) gpu.change(*image, Layout::eUndefined, Layout::eTransferDstOptimal);
  gpu.commands.copyBufferToImage(*weight_bytes, *weights, Layout::eTransferDstOptimal, copies);
  gpu.commands.copyBufferToImage(*word_bytes, *words, Layout::eTransferDstOptimal, whole);
  for (const auto* image : {&weights, &words})
    gpu.change(*image, Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal);

  // Linear between texels and levels, u repeating if the manifest says so; words nearest.
  using Address = vk::SamplerAddressMode;
  vk::SamplerCreateInfo how({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear,
                            number(4) ? Address::eRepeat : Address::eClampToEdge, Address::eClampToEdge);
  how.maxLod = VK_LOD_CLAMP_NONE;
  const vk::raii::Sampler linear(gpu.device, how), nearest(gpu.device, vk::SamplerCreateInfo());
  const auto weights_view = gpu.view(weights, vk::ImageViewType::e2DArray, kBytes);
  const auto words_view = gpu.view(words, vk::ImageViewType::e2D, kWords);
  const auto kImage = vk::DescriptorType::eCombinedImageSampler;
  const auto kFragment = vk::ShaderStageFlagBits::eFragment;
  const vk::DescriptorSetLayoutBinding bindings[] = {{0, kImage, 1, kFragment}, {1, kImage, 1, kFragment}};
  const vk::raii::DescriptorSetLayout set_layout(gpu.device, {{}, bindings});
  const vk::DescriptorPoolSize size(kImage, 2);
  const vk::raii::DescriptorPool pool(gpu.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
  const vk::raii::DescriptorSet set = std::move(vk::raii::DescriptorSets(gpu.device, {*pool, *set_layout}).front());
  const vk::DescriptorImageInfo texels(*linear, *weights_view, Layout::eShaderReadOnlyOptimal);
  const vk::DescriptorImageInfo numbers(*nearest, *words_view, Layout::eShaderReadOnlyOptimal);
  gpu.device.updateDescriptorSets({{*set, 0, 0, kImage, texels}, {*set, 1, 0, kImage, numbers}}, {});

  // The pipeline: 12 floats a vertex, colour as floats, depth.
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex | kFragment, 0, sizeof eye);
  const vk::raii::PipelineLayout layout(gpu.device, {{}, *set_layout, push});
  const auto module_of = [&](const char* file) {
    const std::string code = read(file);
    return vk::raii::ShaderModule(gpu.device, {{}, code.size(), reinterpret_cast<const std::uint32_t*>(code.data())});
  };
  const auto vertex = module_of("vulkan.vert.spv"), fragment = module_of("vulkan.frag.spv");
  const vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
                                                      {{}, kFragment, *fragment, "main"}};
  const vk::VertexInputBindingDescription stride(0, 48);
  const auto kVec3 = vk::Format::eR32G32B32Sfloat, kDepth = vk::Format::eD32Sfloat;
  const vk::VertexInputAttributeDescription inputs[] = {{0, 0, kVec3, 0},
                                                        {1, 0, kVec3, 12},
                                                        {2, 0, kVec3, 24},
                                                        {3, 0, vk::Format::eR32G32Sfloat, 36},
                                                        {4, 0, vk::Format::eR32Sfloat, 44}};
  const vk::PipelineVertexInputStateCreateInfo input({}, stride, inputs);
  const vk::PipelineInputAssemblyStateCreateInfo triangles({}, vk::PrimitiveTopology::eTriangleList);
  const vk::Viewport viewport(0, 0, float(pixels), float(pixels), 0, 1);
  const vk::Rect2D area({}, {pixels, pixels});
  const vk::PipelineViewportStateCreateInfo view({}, viewport, area);
  vk::PipelineRasterizationStateCreateInfo raster;
  raster.lineWidth = 1;
  const vk::PipelineMultisampleStateCreateInfo samples;
  const vk::PipelineDepthStencilStateCreateInfo depth_test({}, true, true, vk::CompareOp::eLess);
  vk::PipelineColorBlendAttachmentState opaque;
  opaque.colorWriteMask = vk::ColorComponentFlags(15);
  const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, opaque);
  const vk::PipelineRenderingCreateInfo targets(0, kFloats, kDepth);
  const vk::raii::Pipeline pipeline(gpu.device, nullptr,
                                    {{},
                                     stages,
                                     &input,
                                     &triangles,
                                     nullptr,
                                     &view,
                                     &raster,
                                     &samples,
                                     &depth_test,
                                     &blend,
                                     nullptr,
                                     *layout,
                                     {},
                                     0,
                                     {},
                                     0,
                                     &targets});

  // Draw, and copy the picture out.
  const auto color = gpu.image(kFloats, pixels, pixels, 1, 1, Use::eColorAttachment | Use::eTransferSrc);
  const auto depth = gpu.image(kDepth, pixels, pixels, 1, 1, Use::eDepthStencilAttachment);
  const auto color_view = gpu.view(color, vk::ImageViewType::e2D, kFloats);
  const auto depth_view = gpu.view(depth, vk::ImageViewType::e2D, kDepth, vk::ImageAspectFlagBits::eDepth);
  gpu.change(color, Layout::eUndefined, Layout::eColorAttachmentOptimal);
  gpu.change(depth, Layout::eUndefined, Layout::eDepthAttachmentOptimal, vk::ImageAspectFlagBits::eDepth);
  const auto attachment = [&](vk::ImageView of, Layout in, vk::ClearValue clear) {
    return vk::RenderingAttachmentInfo(of, in, {}, {}, {}, vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                       clear);
  };
  const auto color_target =
      attachment(*color_view, Layout::eColorAttachmentOptimal, vk::ClearColorValue(std::array{-1.f, -1.f, -1.f, 1.f}));
  const auto depth_target = attachment(*depth_view, Layout::eDepthAttachmentOptimal, vk::ClearDepthStencilValue(1));
  const auto mesh = gpu.buffer(read(folder + "/mesh.bin"),
                               vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer);
  gpu.commands.beginRendering({{}, area, 1, 0, color_target, &depth_target});
  gpu.commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
  gpu.commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout, 0, *set, {});
  gpu.commands.pushConstants<float>(*layout, push.stageFlags, 0, eye);
  gpu.commands.bindVertexBuffers(0, *mesh, vk::DeviceSize(0));
  gpu.commands.bindIndexBuffer(*mesh, 48ull * number(6), vk::IndexType::eUint32);
  gpu.commands.drawIndexed(number(7), 1, 0, 0, 0);
  gpu.commands.endRendering();
  gpu.change(color, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal);
  void* mapped = nullptr;
  const auto read_back =
      gpu.buffer(std::string(std::size_t(16) * pixels * pixels, '\0'), vk::BufferUsageFlagBits::eTransferDst, &mapped);
  gpu.commands.copyImageToBuffer(
      *color, Layout::eTransferSrcOptimal, *read_back,
      vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {pixels, pixels, 1}));
  gpu.commands.end();
  gpu.device.getQueue(0, 0).submit(vk::SubmitInfo({}, {}, *gpu.commands));
  gpu.device.waitIdle();

  // PFM: rows from below, which is where y = -1 stands for either.
  std::ofstream out(arguments[12], std::ios::binary);
  out << "PF\n" << pixels << " " << pixels << "\n-1.0\n";
  for (std::uint32_t i = 0; i < pixels * pixels; ++i) out.write(static_cast<const char*>(mapped) + 16 * i, 12);
  return !out;
}
