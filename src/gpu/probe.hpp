// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/layout.h"

namespace impinge::gpu {

/// Trials at the borders of rounding, of cancellation and of what a float can hold. The same every time.
std::vector<ProbeCase> probe_cases();

/// What is wrong with the answers, as a sentence without its full stop; empty if every bound of the shaders holds for
/// such a device: sums, differences and products rounded to a neighbour, nothing fused or left out, nothing lost but
/// what is below 2^-126.
std::string judge(std::span<const ProbeCase> cases, std::span<const ProbeAnswer> answers);

/// Has the device answer the trials, and judges them.
std::string probe(Device& device);

/// The same of double precision, on a device that has it.
std::vector<DoubleCase> double_cases();
std::string judge(std::span<const DoubleCase> cases, std::span<const DoubleAnswer> answers);
std::string probe_doubles(Device& device);

}  // namespace impinge::gpu
