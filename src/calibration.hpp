// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "schedule/cost.hpp"

namespace impinge {

/// The cost function's constants on this machine, measured once a process on a small built-in scene (some
/// milliseconds).
const schedule::CostConstants& calibrated_constants();

}  // namespace impinge
