// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "impinge/measures.hpp"
#include "motion/four_points.hpp"

namespace impinge::motion {

/// The points whose differences, second minus first, span a volume.
using Spanning = std::array<std::array<std::size_t, 2>, 3>;

/// Between neighbouring doubles each, and inside, in their order.
struct RootTimes {
  std::array<Interval, 3> times;
  std::size_t count = 0;
};

/// The roots in [0, 1] of the volume that three moving differences span, each a simple one; nothing where floating
/// point of twice a double's precision cannot tell them for certain.
std::optional<RootTimes> rounded_roots(const FourPoints& from, const FourPoints& to, const Spanning& spanning);

}  // namespace impinge::motion
