// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/devices.hpp"

#include "core/guarded.hpp"
#include "pipeline/ready_device.hpp"

namespace impinge {
namespace {

DeviceInfo::Type type_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceInfo::Type::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceInfo::Type::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceInfo::Type::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceInfo::Type::cpu;
    default:
      return DeviceInfo::Type::other;
  }
}

}  // namespace

Result<std::vector<DeviceInfo>> devices() {
  return guarded([]() -> Result<std::vector<DeviceInfo>> {
    std::vector<DeviceInfo> found;
    for (const gpu::FoundDevice& known : gpu::Devices::of_process().list()) {
      const gpu::PhysicalDevice& device = known.physical;
      found.push_back({.name = device.properties.deviceName,
                       .driver = device.driver,
                       .type = type_of(device.properties.deviceType),
                       .memory_bytes = device.memory,
                       .largest_buffer_bytes = device.properties.limits.maxStorageBufferRange,
                       .subgroup_size = device.subgroup_size,
                       .has_doubles = device.has_doubles,
                       .has_int64 = device.has_int64,
                       .is_certified = known.complaint.empty(),
                       .complaint = known.complaint});
    }
    if (found.empty()) return Error{Code::no_device, gpu::Devices::of_process().complaint()};
    return found;
  });
}

}  // namespace impinge
