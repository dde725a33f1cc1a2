// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>

namespace impinge::hierarchy {

/// Memory for what lives as long as the arena: handed out from a few large blocks, in whole cache lines, and given back
/// all at once. Safe from many threads.
class Arena {
 public:
  static constexpr std::size_t kAlignment = 64;

  Arena() = default;
  ~Arena() {
    while (last_ != nullptr) {
      Block* const block = last_;
      last_ = block->before;
      ::operator delete(block);
    }
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  [[nodiscard]] void* allocate(std::size_t bytes) {
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    const std::lock_guard lock(mutex_);
    if (bytes > left_) add_block(bytes);
    std::byte* const result = next_;
    next_ += bytes, left_ -= bytes;
    return result;
  }

  [[nodiscard]] std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return total_;
  }

 private:
  struct Block {
    Block* before;
  };
  /// Blocks grow with the arena: at most an eighth of it is unused, and a small mesh takes little.
  static constexpr std::size_t kSmallest = std::size_t{1} << 11, kLargest = std::size_t{1} << 18;

  void add_block(std::size_t bytes) {
    const std::size_t room = std::max(bytes, std::clamp(total_ / 8, kSmallest, kLargest));
    const std::size_t size = sizeof(Block) + kAlignment + room;
    last_ = new (::operator new(size)) Block{last_};
    const auto begin = reinterpret_cast<std::uintptr_t>(last_ + 1);
    next_ = reinterpret_cast<std::byte*>(last_ + 1) + (kAlignment - begin % kAlignment) % kAlignment;
    left_ = room, total_ += size;
  }

  mutable std::mutex mutex_;
  Block* last_ = nullptr;
  std::byte* next_ = nullptr;
  std::size_t left_ = 0, total_ = 0;
};

}  // namespace impinge::hierarchy
