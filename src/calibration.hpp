// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "gpu/opened.hpp"
#include "schedule/cost.hpp"
#include "schedule/split.hpp"

namespace impinge {

/// The cost function's constants of a backend on this machine, measured once a process on a small built-in scene (some
/// milliseconds).
const schedule::CostConstants& calibrated_constants(std::string_view backend);

/// Likewise of a device, whose programs are made ready on the way: some tenths of a second. A gpu::Failure passes.
const schedule::DeviceConstants& calibrated_device(const std::shared_ptr<gpu::Opened>& device);

}  // namespace impinge
