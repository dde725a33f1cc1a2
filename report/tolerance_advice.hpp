// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace impinge::report {

struct Review;

/// How far the parts of a failing pair reach into each other.
struct Reach {
  double fails_below = 0;  ///< as `Clash::fails_below`
  double depth = 0;        ///< the upper end of the greater of both; 0 for surfaces
};

/// A tolerance that many of the failing pairs do not reach, though the others go far beyond it.
struct ToleranceAdvice {
  double tolerance = 0;       ///< of two digits
  std::size_t shallower = 0;  ///< how many of the failing pairs it excuses
};

/// Advises a tolerance in the widest gap between the depths of pairs, on a logarithmic scale. Round parts that touch by
/// design overlap by what their facets leave, and many such overlaps are of about one size, far from the depth of real
/// clashes. Depths are known to a few per cent: a gap is from an upper end to a lower one. Pairs that no tolerance
/// excuses end the last gap by their depth. Nothing where no gap is wide, or few pairs would go. `least`, above 0: the
/// tolerance is larger.
std::optional<ToleranceAdvice> advise_tolerance(std::span<const Reach> failing, double least);

/// The same of a review in which a pair fails by its overlap alone: nothing where tests, contact or a clearance say
/// what fails.
std::optional<ToleranceAdvice> advise_tolerance(const Review& review);

}  // namespace impinge::report
