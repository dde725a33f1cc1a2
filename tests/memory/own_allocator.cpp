// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/memory/own_allocator.hpp"

#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace impinge::test {
namespace {

void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (countdown.load() >= 0 && countdown.fetch_sub(1) == 0) throw std::bad_alloc();
  void* memory = std::aligned_alloc(alignment, (size + alignment) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  live_bytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}

void release(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace
}  // namespace impinge::test

void* operator new(std::size_t size) { return impinge::test::allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return impinge::test::allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { impinge::test::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { impinge::test::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { impinge::test::release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { impinge::test::release(memory); }
