// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "gpu/vk.hpp"

namespace impinge::gpu {

/// A device as Vulkan describes it, without having been opened.
struct PhysicalDevice {
  VkPhysicalDevice handle;
  VkPhysicalDeviceProperties properties;
  std::string driver;           ///< its name and version, as it gives them
  std::uint64_t memory;         ///< of its largest own heap, in bytes
  std::uint32_t subgroup_size;  ///< invocations that run in step
  std::uint32_t queue_family;   ///< one that computes, and draws if any does both
  bool draws;                   ///< that family draws as well
  bool has_doubles, has_int64;
  bool fragments_store;  ///< fragment shaders may write to buffers
};

/// Vulkan itself: found when the program runs, or not at all. Made once a process, and kept to its end.
class Instance {
 public:
  /// `validate`: with the validation layer, whose messages are counted.
  explicit Instance(bool validate);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Usable devices, the likely fastest first: discrete, integrated, virtual, then the CPU.
  [[nodiscard]] const std::vector<PhysicalDevice>& devices() const { return devices_; }
  /// Why there are none, as a sentence without its full stop; empty if there are.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

  /// What the validation layer has said so far.
  [[nodiscard]] static unsigned validation_messages();

 private:
  void enumerate();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::vector<PhysicalDevice> devices_;
  std::string complaint_;
};

}  // namespace impinge::gpu
