// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.hpp"

namespace impinge::gpu {

/// A compute shader with the buffers that it declares, no more and no fewer, and its push constants.
class Kernel {
 public:
  Kernel(Device& device, std::span<const std::uint32_t> spirv, std::vector<std::uint32_t> bindings,
         std::uint32_t push_bytes);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  [[nodiscard]] const std::vector<std::uint32_t>& bindings() const { return bindings_; }
  [[nodiscard]] VkDescriptorSetLayout layout() const { return set_layout_; }

  /// Readies the shader, its buffers and, if it has any, its push constants for dispatches.
  void bind(VkCommandBuffer commands, VkDescriptorSet set, const void* push_constants) const;

 private:
  void release();

  Device& device_;
  std::vector<std::uint32_t> bindings_;
  std::uint32_t push_bytes_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout pipeline_layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// The buffers of some kernels' next dispatches.
class Bindings {
 public:
  explicit Bindings(Device& device, std::vector<const Kernel*> kernels);
  ~Bindings();
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

  /// A buffer for all the kernels that have the binding; none of them may be running.
  void set(std::uint32_t binding, const Buffer& buffer);
  [[nodiscard]] VkDescriptorSet of(const Kernel& kernel) const;

 private:
  Device& device_;
  std::vector<const Kernel*> kernels_;
  std::vector<VkDescriptorSet> sets_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

}  // namespace impinge::gpu
