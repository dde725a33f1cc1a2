// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/image.hpp"

namespace impinge::gpu {
namespace {

/// Which every device can fetch from.
constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkImageSubresourceRange kAll{
    .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .baseMipLevel = 0, .levelCount = 1, .baseArrayLayer = 0, .layerCount = 1};

}  // namespace

Image::Image(Device& device, std::uint32_t width, std::uint32_t height)
    : device_(device), width_(width), height_(height) {
  device.reserve(std::uint64_t{width} * height * kTexelBytes);
  try {
    const VkImageCreateInfo image{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = kFormat,
                                  .extent = {width, height, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = VK_SAMPLE_COUNT_1_BIT,
                                  .tiling = VK_IMAGE_TILING_OPTIMAL,
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                  .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    check(vkCreateImage(device.handle(), &image, nullptr, &image_), "making a texture");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    memory_ = device.allocate(needs, Buffer::Use::device);
    check(vkBindImageMemory(device.handle(), image_, memory_, 0), "binding memory");
    const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image_,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = kFormat,
                                     .subresourceRange = kAll};
    check(vkCreateImageView(device.handle(), &view, nullptr, &view_), "making a texture");
  } catch (...) {
    release();
    throw;
  }
}

Image::~Image() { release(); }

void Image::release() {
  vkDestroyImageView(device_.handle(), view_, nullptr);
  vkDestroyImage(device_.handle(), image_, nullptr);
  vkFreeMemory(device_.handle(), memory_, nullptr);
  device_.bytes_in_use_ -= std::uint64_t{width_} * height_ * kTexelBytes;
}

void Image::fill(VkCommandBuffer commands, const Buffer& from, std::uint32_t rows) const {
  VkImageMemoryBarrier turn{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                            .srcAccessMask = 0,
                            .dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                            .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
                            .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                            .image = image_,
                            .subresourceRange = kAll};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr,
                       0, nullptr, 1, &turn);
  const VkBufferImageCopy region{
      .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
      .imageExtent = {width_, rows, 1},
  };
  vkCmdCopyBufferToImage(commands, from.handle(), image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  turn.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, turn.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
  turn.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, turn.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr,
                       0, nullptr, 1, &turn);
}

}  // namespace impinge::gpu
