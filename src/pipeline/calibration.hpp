// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "pipeline/ready_device.hpp"
#include "schedule/cost.hpp"
#include "schedule/split.hpp"

namespace impinge {

/// The cost function's constants of a backend on this machine: as another run has measured them (set_calibration), or
/// measured now, once, on small built-in scenes (some tenths of a second).
schedule::CostConstants calibrated_constants(std::string_view backend);

/// Likewise of a device, whose programs are made ready on the way: some tenths of a second, unless it is known from
/// before. A gpu::Failure passes.
schedule::DeviceConstants calibrated_device(const std::shared_ptr<gpu::ReadyDevice>& device);

/// A part of a query was predicted to take so long, and took so long: the constants follow, a little at a time.
void refine_calibration(const std::shared_ptr<gpu::ReadyDevice>& device, double predicted_seconds, double seconds);

}  // namespace impinge
