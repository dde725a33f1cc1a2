// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "schedule/cost.hpp"
#include "schedule/split.hpp"

namespace impinge {

namespace gpu {
class ReadyDevice;
}  // namespace gpu

/// The cost function's constants of a backend on this machine: as another run has measured them (set_calibration), or
/// measured now, once, on small built-in scenes (some tenths of a second). With trees of that leaf size; 0: the
/// backend's own.
schedule::CostConstants calibrated_constants(std::string_view backend, std::uint32_t leaf_size = 0);

/// Likewise of a device, whose programs are made ready on the way: some tenths of a second, unless it is known from
/// before. A gpu::Failure passes.
schedule::DeviceConstants calibrated_device(const std::shared_ptr<gpu::ReadyDevice>& device);

/// The device's and the constants of "simd", if both take no time to get: nothing while any are being measured.
struct KnownConstants {
  schedule::DeviceConstants device;
  schedule::CostConstants cpu;
};
std::optional<KnownConstants> known_constants(const std::shared_ptr<gpu::ReadyDevice>& device);

/// A part of a query was predicted to take so long, and took so long: the constants follow, a little at a time.
void refine_calibration(const std::shared_ptr<gpu::ReadyDevice>& device, double predicted_seconds, double seconds);

}  // namespace impinge
