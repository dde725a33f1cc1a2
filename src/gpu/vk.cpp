// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/vk.hpp"

#define VOLK_IMPLEMENTATION
#include <volk.h>

namespace impinge::gpu {
namespace {

std::string meaning(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "the driver ran out of memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "the device ran out of memory";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver could not start";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver was found";
    default:
      return "Vulkan's result was " + std::to_string(static_cast<int>(result));
  }
}

}  // namespace

void check(VkResult result, const char* what) {
  if (result >= 0) return;
  throw Failure(std::string(what) + ": " + meaning(result), result);
}

}  // namespace impinge::gpu
