// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "gpu/device.hpp"
#include "gpu/image.hpp"
#include "gpu/layout.h"

namespace impinge::gpu {

/// A fragment shader to be run on the texels of quads, in a framebuffer of kRasterWidth by kRasterHeight without
/// attachments: the shader writes to a buffer. Safe from many threads.
class Drawing {
 public:
  /// `input`: of binding 0, a sampled image or a storage buffer. Binding 1 is the list of runs, 2 what is written.
  Drawing(Device& device, std::span<const std::uint32_t> fragment_spirv, VkDescriptorType input);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  /// Draws the first so many runs. `query`: a pool of one occlusion query, which counts the texels that were not
  /// discarded; or null.
  void draw(VkCommandBuffer commands, VkDescriptorSet set, std::uint32_t runs, VkQueryPool query) const;

  [[nodiscard]] Device& device() const { return device_; }
  [[nodiscard]] VkDescriptorSetLayout layout() const { return set_layout_; }
  [[nodiscard]] VkDescriptorType input() const { return input_; }

 private:
  void make_layout();
  void make_target();
  void make_pipeline(std::span<const std::uint32_t> fragment_spirv);
  void release();

  Device& device_;
  VkDescriptorType input_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout pipeline_layout_ = VK_NULL_HANDLE;
  VkRenderPass pass_ = VK_NULL_HANDLE;
  VkFramebuffer target_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// What a drawing reads and writes.
class DrawingBindings {
 public:
  DrawingBindings(const Drawing& drawing, const Image& input, const Buffer& runs, const Buffer& output);
  DrawingBindings(const Drawing& drawing, const Buffer& input, const Buffer& runs, const Buffer& output);
  ~DrawingBindings();
  DrawingBindings(const DrawingBindings&) = delete;
  DrawingBindings& operator=(const DrawingBindings&) = delete;

  [[nodiscard]] VkDescriptorSet set() const { return set_; }

 private:
  explicit DrawingBindings(const Drawing& drawing);
  void write(std::uint32_t binding, const Buffer& buffer);

  Device& device_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace impinge::gpu
