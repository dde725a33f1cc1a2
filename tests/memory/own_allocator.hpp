// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

/// The program's allocator is replaced by one that counts, and fails when told to.
namespace impinge::test {

inline std::atomic<long> countdown{-1};  ///< allocations until the one that fails; negative: none does
inline std::atomic<long> allocations{0};
inline std::atomic<long> live_bytes{0};

}  // namespace impinge::test
