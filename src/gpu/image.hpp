// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "gpu/device.hpp"

namespace impinge::gpu {

/// A texture of four floats a texel, which shaders fetch. The device must outlive it, and have finished with it when it
/// is destroyed.
class Image {
 public:
  static constexpr std::uint32_t kTexelBytes = 16;
  Image(Device& device, std::uint32_t width, std::uint32_t height);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  /// Its first rows anew, from the buffer's beginning; the others hold nothing from then on. Shaders see it.
  void fill(VkCommandBuffer commands, const Buffer& from, std::uint32_t rows) const;
  [[nodiscard]] VkImageView view() const { return view_; }

 private:
  void release();

  Device& device_;
  std::uint32_t width_, height_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
};

}  // namespace impinge::gpu
