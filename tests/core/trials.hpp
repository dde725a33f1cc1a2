// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace impinge::test {

/// Sanitizers look for wrong uses of memory, threads and arithmetic, which few trials show as well as many; that
/// answers are right is for the builds without them. There a trial takes five to twenty times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// How many of n trials this build makes: a tenth under sanitizers, and at least one.
template <class Integer>
constexpr Integer trials(Integer n) {
  return kSanitized ? std::max<Integer>(1, n / 10) : n;
}

}  // namespace impinge::test
