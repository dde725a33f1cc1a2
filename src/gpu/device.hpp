// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>

#include "gpu/instance.hpp"

namespace impinge::gpu {

/// What a device's memory is used for, and failures that tests bring about.
struct Limits {
  std::uint64_t budget = 0;                           ///< bytes in all; 0: half of the device's memory
  std::uint64_t largest_buffer = 0;                   ///< bytes; 0: what the device allows
  std::uint64_t page = std::uint64_t{64} << 20;       ///< bytes that meshes share
  std::uint32_t stack = 0, leaf_pairs = 0, hits = 0;  ///< items of a walk's lists; 0: what suits the device
  std::uint32_t most_groups = 0;                      ///< of a dispatch; 0: what the device allows
  bool trusts_software = false;                       ///< a hybrid query gives work to a device that is the CPU itself
  bool no_doubles = false;                            ///< does without them even where the device has some
  std::atomic<int>* fail_allocation = nullptr;        ///< counts down; at 0 an allocation fails
  std::atomic<int>* lose_device = nullptr;            ///< counts down; at 0 a submission loses the device
  std::atomic<int>* overruns = nullptr;               ///< counts the buffers beyond whose ends something was written
};

class Device;

/// A buffer with memory of its own. The device must outlive it, and have finished with it when it is destroyed.
class Buffer {
 public:
  enum class Use : std::uint8_t {
    device,    ///< the device alone reads and writes it
    upload,    ///< written by the host, copied from
    readback,  ///< written by the device, read by the host
  };
  Buffer() = default;
  Buffer(Device& device, std::uint64_t bytes, Use use);
  ~Buffer();
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] VkBuffer handle() const { return buffer_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// The bytes that are bound for shaders: with the guard behind the buffer, if there is one, so that a write beyond
  /// the end is not stopped by the driver and shows.
  [[nodiscard]] std::uint64_t shown_bytes() const { return bytes_ + guard_; }
  /// Null for `Use::device`.
  template <class T>
  [[nodiscard]] T* mapped() const {
    return static_cast<T*>(mapped_);
  }

 private:
  void allocate(Use use);
  void release();
  void set_guard();
  [[nodiscard]] bool guard_is_whole();

  Device* device_ = nullptr;
  std::uint64_t guard_ = 0;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* mapped_ = nullptr;
  std::uint64_t bytes_ = 0;
};

/// An opened device: a queue and memory. Safe from many threads. Every call may throw a Failure; after one that lost
/// the device, all do.
class Device {
 public:
  Device(const PhysicalDevice& physical, const Limits& limits);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice handle() const { return device_; }
  [[nodiscard]] const PhysicalDevice& physical() const { return physical_; }
  [[nodiscard]] const Limits& limits() const { return limits_; }  ///< none of them 0
  [[nodiscard]] std::uint64_t bytes_in_use() const { return bytes_in_use_; }
  [[nodiscard]] bool is_lost() const { return is_lost_; }

  void submit(VkCommandBuffer commands, VkFence fence);
  void wait(VkFence fence);

 private:
  friend class Buffer;
  friend class Image;
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, Buffer::Use use) const;
  /// Throws a Failure if the budget does not allow so many bytes more; else they count as in use.
  void reserve(std::uint64_t bytes);
  [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, Buffer::Use use) const;

  PhysicalDevice physical_;
  Limits limits_;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queue_mutex_;
  std::atomic<std::uint64_t> bytes_in_use_{0};
  std::atomic<bool> is_lost_{false};
};

/// Commands that are recorded, submitted and waited for, again and again. One thread uses it at a time.
class Commands {
 public:
  explicit Commands(Device& device);
  ~Commands();
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  /// Records and submits; what ran before must have been waited for.
  void start(const std::function<void(VkCommandBuffer)>& record);
  void wait();

 private:
  Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  bool is_running_ = false;
};

/// What was written before is seen by all that follows: kernels, copies, indirect dispatches and drawing, or those of
/// some stages.
void barrier(VkCommandBuffer commands, VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
/// What was written before is seen by the host once it has waited.
void hand_to_host(VkCommandBuffer commands);
void copy(VkCommandBuffer commands, const Buffer& from, std::uint64_t from_byte, const Buffer& to,
          std::uint64_t to_byte, std::uint64_t bytes);

}  // namespace impinge::gpu
