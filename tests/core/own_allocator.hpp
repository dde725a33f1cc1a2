// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

/// Replaces the program's allocator by one that counts, and fails when told to. For one file of a program.
namespace impinge::test {

inline std::atomic<long> countdown{-1};  ///< allocations until the one that fails; negative: none does
inline std::atomic<long> allocations{0};
inline std::atomic<long> live_bytes{0};

inline void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (countdown.load() >= 0 && countdown.fetch_sub(1) == 0) throw std::bad_alloc();
  void* memory = std::aligned_alloc(alignment, (size + alignment) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  live_bytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}

inline void release(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace impinge::test

// Not inlined: the compiler would otherwise see free() meet new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return impinge::test::allocate(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return impinge::test::allocate(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { impinge::test::release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { impinge::test::release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { impinge::test::release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  impinge::test::release(memory);
}
