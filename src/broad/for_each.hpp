// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace impinge::broad {

/// Runs body(0) to body(n - 1), in any order and perhaps at once, and returns when all are done. The stage knows
/// nothing of threads: whoever calls it says how. Empty: one after the other.
using ForEach = std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)>;

}  // namespace impinge::broad
