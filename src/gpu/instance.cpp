// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/instance.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace impinge::gpu {
namespace {

std::atomic<unsigned> messages{0};

VKAPI_ATTR VkBool32 VKAPI_CALL count_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
  ++messages;
  std::fprintf(stderr, "Vulkan's validation: %s\n", data->pMessage);
  return VK_FALSE;
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 3;
    default:
      return 4;
  }
}

/// Nothing if no family of queues computes.
std::optional<PhysicalDevice> describe(VkPhysicalDevice handle) {
  PhysicalDevice device{.handle = handle};
  VkPhysicalDeviceSubgroupProperties subgroup{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
  VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                          .pNext = &subgroup};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
  vkGetPhysicalDeviceProperties2(handle, &properties);
  device.properties = properties.properties;
  if (device.properties.apiVersion < VK_API_VERSION_1_2) return std::nullopt;
  device.driver = std::string(driver.driverName) + (driver.driverInfo[0] != 0 ? " " : "") + driver.driverInfo;
  device.subgroup_size = subgroup.subgroupSize;

  VkPhysicalDeviceFeatures features;
  vkGetPhysicalDeviceFeatures(handle, &features);
  device.has_doubles = features.shaderFloat64 != 0;
  device.has_int64 = features.shaderInt64 != 0;
  device.fragments_store = features.fragmentStoresAndAtomics != 0;

  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(handle, &memory);
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      device.memory = std::max<std::uint64_t>(device.memory, memory.memoryHeaps[i].size);

  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, families.data());
  bool computes = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const VkQueueFlags flags = families[i].queueFlags;
    const bool draws = (flags & VK_QUEUE_GRAPHICS_BIT) != 0;
    if ((flags & VK_QUEUE_COMPUTE_BIT) == 0 || (computes && (device.draws || !draws))) continue;
    computes = true;
    device.queue_family = i, device.draws = draws;
  }
  if (!computes) return std::nullopt;
  return device;
}

}  // namespace

Instance::Instance(bool validate) {
  if (volkInitialize() != VK_SUCCESS) {
    complaint_ = "Vulkan's loader is not installed (libvulkan.so.1, Debian's libvulkan1)";
    return;
  }
  if (vkEnumerateInstanceVersion == nullptr) {  // a loader of Vulkan 1.0
    complaint_ = "Vulkan's loader is older than Vulkan 1.2";
    return;
  }
  const VkApplicationInfo application{
      .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "impinge", .apiVersion = VK_API_VERSION_1_2};
  const char* const layer = "VK_LAYER_KHRONOS_validation";
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pApplicationInfo = &application,
                                  .enabledLayerCount = validate ? 1u : 0u,
                                  .ppEnabledLayerNames = &layer,
                                  .enabledExtensionCount = validate ? 1u : 0u,
                                  .ppEnabledExtensionNames = &extension};
  if (const VkResult result = vkCreateInstance(&info, nullptr, &instance_); result < 0) {
    instance_ = VK_NULL_HANDLE;
    complaint_ = result == VK_ERROR_LAYER_NOT_PRESENT
                     ? "Vulkan's validation layer is not installed (Debian's vulkan-validationlayers)"
                     : "Vulkan has no driver that could be started (Debian's mesa-vulkan-drivers has some)";
    return;
  }
  volkLoadInstance(instance_);
  if (validate) {
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = count_message};
    check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_), "listening to the validation");
  }
  enumerate();
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Instance::enumerate() {
  std::uint32_t count = 0;
  std::vector<VkPhysicalDevice> handles;
  VkResult result = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  if (result >= 0) {
    handles.resize(count);
    result = vkEnumeratePhysicalDevices(instance_, &count, handles.data());
    handles.resize(result >= 0 ? count : 0);
  }
  for (VkPhysicalDevice handle : handles)
    if (const auto device = describe(handle)) devices_.push_back(*device);
  std::stable_sort(devices_.begin(), devices_.end(), [](const PhysicalDevice& p, const PhysicalDevice& q) {
    return rank(p.properties.deviceType) < rank(q.properties.deviceType);
  });
  if (devices_.empty())
    complaint_ = handles.empty() ? "Vulkan knows of no device (Debian's mesa-vulkan-drivers has drivers)"
                                 : "no device does Vulkan 1.2 compute";
}

unsigned Instance::validation_messages() { return messages; }

}  // namespace impinge::gpu
