// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>

#include "clash/reach.hpp"
#include "impinge/measures.hpp"

namespace impinge::clash {

/// The volume that the closed pieces of two parts have in common: the integral of the product of both winding numbers,
/// in whatever direction they wind. Nothing if no small shift brings two of them into general position. Once it is
/// stopped, the result is meaningless.
std::optional<OverlapVolume> overlap_volume(const PlacedPart& a, const PlacedPart& b, const std::stop_token& stop);

}  // namespace impinge::clash
