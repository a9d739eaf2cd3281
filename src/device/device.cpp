// Finding devices, and opening one.
#include "device/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <map>
#include <optional>

#include "device/device_impl.h"

namespace redmap {
namespace {

/// Buffers, dispatches and pictures need no more than this; llvmpipe of Debian 12 has 1.3.
constexpr std::uint32_t kVulkanVersion = VK_API_VERSION_1_1;

VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  static_cast<ValidationLog*>(log)->add(data->pMessage);
  return VK_FALSE;
}

bool has_extension(const vk::raii::Context& context, const char* name) {
  const auto extensions = context.enumerateInstanceExtensionProperties();
  return std::ranges::any_of(extensions,
                             [&](const vk::ExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool listens) {
  const vk::ApplicationInfo application("redmap", 0, "redmap", 0, kVulkanVersion);
  const char* const debug = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  vk::InstanceCreateInfo info({}, &application);
  if (listens) info.setPEnabledExtensionNames(debug);
  try {
    return {context, info};
  } catch (const vk::IncompatibleDriverError&) {
    throw Error("Vulkan: expected a driver (Debian's mesa-vulkan-drivers has one for the CPU), found none");
  }
}

std::optional<std::uint32_t> compute_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  return std::nullopt;
}

DeviceInfo info_of(const vk::raii::PhysicalDevice& device, int index) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  const std::uint32_t version = properties.apiVersion;
  vk::PhysicalDeviceDriverProperties driver;
  if (version >= VK_API_VERSION_1_2)  // older drivers do not name themselves
    driver = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                 .get<vk::PhysicalDeviceDriverProperties>();
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName.data();
  info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
  info.vulkan_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                                    VK_API_VERSION_PATCH(version));
  info.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
  return info;
}

std::vector<DeviceInfo> devices_of(const VulkanInstance& vulkan, std::vector<vk::raii::PhysicalDevice>* handles) {
  std::vector<DeviceInfo> infos;
  for (vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(vulkan.instance)) {
    if (!compute_family(device)) continue;
    infos.push_back(info_of(device, static_cast<int>(infos.size())));
    if (handles) handles->push_back(device);
  }
  return infos;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Throws Error where none of `devices` is meant by `choice`.
const DeviceInfo& choose(const std::vector<DeviceInfo>& devices, const std::string& choice) {
  if (devices.empty()) throw Error("Vulkan: expected a device that can compute, found none");
  if (choice.empty()) {
    const auto gpu = std::ranges::find(devices, false, &DeviceInfo::software);
    return gpu == devices.end() ? devices.front() : *gpu;
  }
  int index = -1;
  const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
  const bool is_index = error == std::errc() && end == choice.data() + choice.size();
  std::string names;
  for (const DeviceInfo& device : devices) {
    if (is_index ? device.index == index : lower(device.name).find(lower(choice)) != std::string::npos) return device;
    names += fmt::format("{}{} \"{}\"", names.empty() ? "" : ", ", device.index, device.name);
  }
  throw Error("device \"{}\": expected the number or part of the name of one of {}", choice, names);
}

/// Whatever of Vulkan's core the device has, so that shaders may use it; robustBufferAccess is always there.
vk::PhysicalDeviceFeatures wanted_features(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceFeatures there = device.getFeatures();
  vk::PhysicalDeviceFeatures wanted;
  wanted.robustBufferAccess = true;
  wanted.shaderFloat64 = there.shaderFloat64;
  wanted.shaderInt64 = there.shaderInt64;
  wanted.geometryShader = there.geometryShader;  // fragment shaders are told the triangle's number
  return wanted;
}

}  // namespace

void ValidationLog::add(const char* message) {
  const std::scoped_lock lock(mutex_);
  if (first_.empty()) first_ = message;
}

void ValidationLog::check() {
  const std::scoped_lock lock(mutex_);
  if (!first_.empty()) throw Error("{}", std::exchange(first_, {}));
}

VulkanInstance::VulkanInstance() {
  const bool listens = has_extension(context, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  instance = make_instance(context, listens);
  if (!listens) return;
  messenger = {instance,
               vk::DebugUtilsMessengerCreateInfoEXT({}, vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
                                                    vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation, hear, &log)};
}

/// One for all, made by whoever asks first and kept until the process ends: drivers do not like to be unloaded. Throws
/// Error where there is no loader or no driver.
VulkanInstance& VulkanInstance::get() {
  static std::mutex mutex;
  static VulkanInstance* instance = nullptr;
  const std::scoped_lock lock(mutex);
  if (instance) return *instance;
  try {
    instance = new VulkanInstance();
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error&) {  // vulkan.hpp finds no loader
    throw Error("Vulkan: expected its loader (Debian's libvulkan1), found none");
  }
  return *instance;
}

std::vector<DeviceInfo> list_devices() {
  try {
    return devices_of(VulkanInstance::get(), nullptr);
  } catch (const Error&) {
    return {};
  }
}

Device::Device(const std::string& choice) : impl_(std::make_shared<Impl>()) {
  std::vector<vk::raii::PhysicalDevice> handles;
  const std::vector<DeviceInfo> devices = devices_of(impl_->vulkan, &handles);
  impl_->info = choose(devices, choice);
  impl_->physical = handles[impl_->info.index];
  impl_->limits = impl_->physical.getProperties().limits;
  impl_->queue_family = *compute_family(impl_->physical);
  on_device(*impl_, [&] {
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, impl_->queue_family, 1, &priority);
    const vk::PhysicalDeviceFeatures features = wanted_features(impl_->physical);
    impl_->device = {impl_->physical, vk::DeviceCreateInfo({}, queue, {}, {}, &features)};
    impl_->queue = impl_->device.getQueue(impl_->queue_family, 0);
  });
}

Device::~Device() = default;

std::shared_ptr<Device> Device::open(const std::string& choice) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<Device>> open_devices;
  const std::scoped_lock lock(mutex);
  std::weak_ptr<Device>& known = open_devices[choice];
  if (std::shared_ptr<Device> device = known.lock(); device && !device->impl_->stuck) return device;
  std::shared_ptr<Device> device(new Device(choice));
  known = device;
  return device;
}

const DeviceInfo& Device::info() const { return impl_->info; }
std::size_t Device::largest_buffer() const { return impl_->limits.maxStorageBufferRange; }
bool Device::has_doubles() const { return impl_->physical.getFeatures().shaderFloat64; }

void keep_until_exit(std::shared_ptr<void> handles) {
  static std::mutex mutex;
  static auto* kept = new std::vector<std::shared_ptr<void>>;  // never destroyed, not even at exit
  const std::scoped_lock lock(mutex);
  kept->push_back(std::move(handles));
}

}  // namespace redmap
