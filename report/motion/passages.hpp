// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "impinge/measures.hpp"
#include "report/motion/mover.hpp"

namespace impinge::report {

/// Two parts that meet between two frames: when first and when last, as parts of the time between these.
struct Passage {
  std::array<std::uint32_t, 2> objects{};
  double first = 0, last = 1;
};

/// The pairs of parts that meet on the way between two frames, if each goes from its one pose to the other on a screw.
/// Parts of equal `bodies` stand still to each other; parts that change their shape are left out. By the parts' spheres
/// at first, which costs little where few come near each other. Errors: those of `time_of_impact`.
Result<std::vector<Passage>> passages_between(const std::vector<Posed>& from, const std::vector<Posed>& to,
                                              std::span<const std::uint32_t> bodies, const MeasureOptions& options);

}  // namespace impinge::report
