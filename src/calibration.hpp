// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "schedule/cost.hpp"

namespace impinge {

/// The cost function's constants of a backend on this machine, measured once a process on a small built-in scene (some
/// milliseconds).
const schedule::CostConstants& calibrated_constants(std::string_view backend);

}  // namespace impinge
