// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "gpu/device.hpp"

#include <algorithm>
#include <chrono>

namespace impinge::gpu {
namespace {

/// Bytes behind a buffer in which tests look for writes beyond its end.
constexpr std::uint64_t kGuard = 4096;
constexpr std::uint32_t kSentinel = 0xA5C3961E;

/// True once, when the counter that a test has set runs out.
bool is_time_for(std::atomic<int>* counter) { return counter != nullptr && counter->fetch_sub(1) == 0; }

Limits filled_in(Limits limits, const PhysicalDevice& physical) {
  const VkPhysicalDeviceLimits& device = physical.properties.limits;
  // On a software device, which is slow, lists are short so that each submission ends soon.
  const bool is_cpu = physical.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  const auto fill = [](auto& value, auto otherwise) {
    if (value == 0) value = static_cast<std::remove_reference_t<decltype(value)>>(otherwise);
  };
  fill(limits.budget, physical.memory / 2);
  fill(limits.largest_buffer, device.maxStorageBufferRange);
  limits.largest_buffer = std::min<std::uint64_t>(limits.largest_buffer, device.maxStorageBufferRange);
  fill(limits.stack, is_cpu ? 1u << 17 : 1u << 22);
  fill(limits.leaf_pairs, is_cpu ? 1u << 15 : 1u << 20);
  fill(limits.hits, is_cpu ? 1u << 17 : 1u << 21);
  fill(limits.most_groups, device.maxComputeWorkGroupCount[0]);
  limits.most_groups = std::min(limits.most_groups, device.maxComputeWorkGroupCount[0]);
  return limits;
}

}  // namespace

Device::Device(const PhysicalDevice& physical, const Limits& limits)
    : physical_(physical), limits_(filled_in(limits, physical)) {
  vkGetPhysicalDeviceMemoryProperties(physical_.handle, &memory_);
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = physical_.queue_family,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  VkPhysicalDeviceFeatures features{};
  features.shaderFloat64 = physical_.has_doubles ? VK_TRUE : VK_FALSE;
  features.fragmentStoresAndAtomics = physical_.fragments_store ? VK_TRUE : VK_FALSE;
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue,
                                .pEnabledFeatures = &features};
  check(vkCreateDevice(physical_.handle, &info, nullptr, &device_), "opening the device");
  vkGetDeviceQueue(device_, physical_.queue_family, 0, &queue_);
}

Device::~Device() {
  if (device_ == VK_NULL_HANDLE) return;
  vkDeviceWaitIdle(device_);
  vkDestroyDevice(device_, nullptr);
}

void Device::submit(VkCommandBuffer commands, VkFence fence) {
  if (is_time_for(limits_.lose_device)) is_lost_ = true;
  if (is_lost_) check(VK_ERROR_DEVICE_LOST, "submitting work");
  const VkSubmitInfo info{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  const std::lock_guard lock(queue_mutex_);
  const VkResult result = vkQueueSubmit(queue_, 1, &info, fence);
  if (result == VK_ERROR_DEVICE_LOST) is_lost_ = true;
  check(result, "submitting work");
}

// Most submissions end sooner than a sleeping thread is woken: for a while the caller looks by itself, unless the
// device is a program that needs the processor.
void Device::wait(VkFence fence) {
  constexpr std::chrono::milliseconds kPatience{2};
  const bool is_program = physical_.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  VkResult result = VK_NOT_READY;
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!is_program && result == VK_NOT_READY && std::chrono::steady_clock::now() < until)
    result = vkGetFenceStatus(device_, fence);
  if (result == VK_NOT_READY) result = vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX);
  if (result == VK_ERROR_DEVICE_LOST) is_lost_ = true;
  check(result, "waiting for the device");
}

std::uint32_t Device::memory_type(std::uint32_t allowed, Buffer::Use use) const {
  constexpr VkMemoryPropertyFlags kShared = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const auto find = [&](VkMemoryPropertyFlags wanted) {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
      if ((allowed >> i & 1) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return VK_MAX_MEMORY_TYPES;
  };
  VkMemoryPropertyFlags needed = kShared, best = kShared;
  if (use == Buffer::Use::device) needed = 0, best = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  if (use == Buffer::Use::readback) best = kShared | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const std::uint32_t type = find(best);
  const std::uint32_t found = type != VK_MAX_MEMORY_TYPES ? type : find(needed);
  if (found == VK_MAX_MEMORY_TYPES) throw Failure("the device has no memory of the kind needed");
  return found;
}

void Device::reserve(std::uint64_t bytes) {
  if (bytes_in_use_.fetch_add(bytes) + bytes <= limits_.budget) return;
  bytes_in_use_ -= bytes;
  throw Failure("the memory set aside for meshes is used up", VK_ERROR_OUT_OF_DEVICE_MEMORY);
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& needs, Buffer::Use use) const {
  if (is_time_for(limits_.fail_allocation)) check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "allocating memory");
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .allocationSize = needs.size,
                                  .memoryTypeIndex = memory_type(needs.memoryTypeBits, use)};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &info, nullptr, &memory), "allocating memory");
  return memory;
}

Buffer::Buffer(Device& device, std::uint64_t bytes, Use use)
    : device_(&device), bytes_((std::max<std::uint64_t>(bytes, 4) + 3) / 4 * 4) {
  if (device.limits().overruns != nullptr) guard_ = kGuard;
  if (bytes_ > device.limits().largest_buffer)
    throw Failure("a buffer of " + std::to_string(bytes_) + " bytes is more than the device allows");
  device.reserve(bytes_);
  try {
    allocate(use);
    if (guard_ > 0) set_guard();
  } catch (...) {
    release();
    throw;
  }
}

void Buffer::allocate(Use use) {
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = shown_bytes(), .usage = kUsage};
  check(vkCreateBuffer(device_->handle(), &info, nullptr, &buffer_), "making a buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_->handle(), buffer_, &needs);
  memory_ = device_->allocate(needs, use);
  check(vkBindBufferMemory(device_->handle(), buffer_, memory_, 0), "binding memory");
  if (use != Use::device)
    check(vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "mapping memory");
}

Buffer::~Buffer() { release(); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(mapped_, other.mapped_);
  std::swap(bytes_, other.bytes_);
  std::swap(guard_, other.guard_);
  return *this;
}

// A guard is written and read by copies through a buffer of the host's, which has none: only in tests.
void Buffer::set_guard() {
  Commands commands(*device_);
  commands.start([&](VkCommandBuffer buffer) {
    vkCmdFillBuffer(buffer, buffer_, bytes_, VK_WHOLE_SIZE, kSentinel);
    barrier(buffer);
  });
  commands.wait();
}

bool Buffer::guard_is_whole() try {
  Buffer seen;
  seen.device_ = device_, seen.bytes_ = guard_;
  device_->bytes_in_use_ += guard_;
  seen.allocate(Use::readback);
  Commands commands(*device_);
  commands.start([&](VkCommandBuffer buffer) {
    barrier(buffer);
    copy(buffer, *this, bytes_, seen, 0, guard_);
    hand_to_host(buffer);
  });
  commands.wait();
  const auto* const words = seen.mapped<const std::uint32_t>();
  return std::all_of(words, words + guard_ / 4, [](std::uint32_t word) { return word == kSentinel; });
} catch (const Failure&) {
  return true;  // nobody can tell
}

void Buffer::release() {
  if (device_ == nullptr) return;
  if (guard_ > 0 && memory_ != VK_NULL_HANDLE && !device_->is_lost() && !guard_is_whole())
    ++*device_->limits().overruns;
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  vkFreeMemory(device_->handle(), memory_, nullptr);  // unmaps it
  device_->bytes_in_use_ -= bytes_;
  device_ = nullptr;
}

Commands::Commands(Device& device) : device_(device) {
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                     .queueFamilyIndex = device.physical().queue_family};
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  try {
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_), "making room for commands");
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool_,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device.handle(), &info, &buffer_), "making room for commands");
    check(vkCreateFence(device.handle(), &fence, nullptr, &fence_), "making a fence");
  } catch (...) {
    vkDestroyCommandPool(device.handle(), pool_, nullptr);
    throw;
  }
}

Commands::~Commands() {
  if (is_running_) vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
  vkDestroyFence(device_.handle(), fence_, nullptr);
  vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void Commands::start(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(buffer_, &begin), "recording commands");
  record(buffer_);
  check(vkEndCommandBuffer(buffer_), "recording commands");
  check(vkResetFences(device_.handle(), 1, &fence_), "resetting a fence");
  device_.submit(buffer_, fence_);
  is_running_ = true;
}

void Commands::wait() {
  if (!is_running_) return;
  device_.wait(fence_);
  is_running_ = false;
}

namespace {

struct Stages {
  VkPipelineStageFlags before, after;
};
void make_visible(VkCommandBuffer commands, const Stages& stages, VkAccessFlags access) {
  const VkMemoryBarrier all{
      .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER, .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT, .dstAccessMask = access};
  vkCmdPipelineBarrier(commands, stages.before, stages.after, 0, 1, &all, 0, nullptr, 0, nullptr);
}

}  // namespace

void barrier(VkCommandBuffer commands, VkPipelineStageFlags stages) {
  make_visible(commands, {stages, stages}, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
}

void hand_to_host(VkCommandBuffer commands) {
  make_visible(commands, {VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT}, VK_ACCESS_HOST_READ_BIT);
}

void copy(VkCommandBuffer commands, const Buffer& from, std::uint64_t from_byte, const Buffer& to,
          std::uint64_t to_byte, std::uint64_t bytes) {
  if (bytes == 0) return;
  const VkBufferCopy region{.srcOffset = from_byte, .dstOffset = to_byte, .size = bytes};
  vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &region);
}

}  // namespace impinge::gpu
