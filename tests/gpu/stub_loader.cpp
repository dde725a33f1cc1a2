// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// A libvulkan.so.1 of little use: IMPINGE_STUB says what is wrong with it.
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

bool stub_is(std::string_view fault) {
  const char* const wanted = std::getenv("IMPINGE_STUB");
  return wanted != nullptr && wanted == fault;
}

VKAPI_ATTR VkResult VKAPI_CALL version(std::uint32_t* found) {
  *found = VK_API_VERSION_1_2;
  return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL create(const VkInstanceCreateInfo*, const VkAllocationCallbacks*, VkInstance* instance) {
  if (stub_is("fails")) return VK_ERROR_INITIALIZATION_FAILED;
  *instance = reinterpret_cast<VkInstance>(1);
  return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroy(VkInstance, const VkAllocationCallbacks*) {}
VKAPI_ATTR VkResult VKAPI_CALL enumerate(VkInstance, std::uint32_t* count, VkPhysicalDevice*) {
  *count = 0;
  return stub_is("lists nothing") ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
}

}  // namespace

extern "C" VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance, const char* name) {
  const auto named = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (stub_is("is empty")) return nullptr;
  if (named("vkEnumerateInstanceVersion") && !stub_is("is old")) return reinterpret_cast<PFN_vkVoidFunction>(version);
  if (named("vkCreateInstance")) return reinterpret_cast<PFN_vkVoidFunction>(create);
  if (named("vkDestroyInstance")) return reinterpret_cast<PFN_vkVoidFunction>(destroy);
  if (named("vkEnumeratePhysicalDevices")) return reinterpret_cast<PFN_vkVoidFunction>(enumerate);
  return nullptr;
}
