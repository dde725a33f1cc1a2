// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "impinge/measures.hpp"
#include "report/motion/mover.hpp"

namespace impinge::report {

/// Two parts that come near each other between two frames: when first and when last, as parts of the time between
/// these.
struct Passage {
  std::array<std::uint32_t, 2> objects{};
  double first = 0, last = 1;
};

/// Which pairs `passages_between` finds.
struct PassageOptions {
  double tolerance = 0;                                           ///< what is nearer than this counts as near
  std::function<bool(const std::array<std::uint32_t, 2>&)> skip;  ///< pairs to leave out, lower number first
  MeasureOptions measure;
};

/// The pairs of parts that come near each other on the way between two frames, if each goes from its one pose to the
/// other on a screw: a superset of those that penetrate there. Near is the tolerance, and at least 2^-10 of the smaller
/// part's radius, which keeps conservative advancement short. Parts of equal `bodies` stand still to each other; parts
/// that change their shape and pairs that leave the exact domain on the way are left out. The boxes of the parts'
/// swept spheres are tested first. Errors: those of `time_of_impact` but `out_of_range`.
Result<std::vector<Passage>> passages_between(const std::vector<Posed>& from, const std::vector<Posed>& to,
                                              std::span<const std::uint32_t> bodies, const PassageOptions& options);

}  // namespace impinge::report
