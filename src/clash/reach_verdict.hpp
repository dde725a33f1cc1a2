// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "clash/reach.hpp"
#include "impinge/clash.hpp"

namespace impinge::clash {

/// What is said of a pair at a tolerance.
struct ReachVerdict {
  Verdict verdict = Verdict::apart;
  int inner = -1;          ///< with `inside`: which of the two
  bool undecided = false;  ///< the upper ends of the depths would say that it fails
};

/// `reach` is that of the two parts; it decides whether the pair fails, and only the name of what fails needs more.
ReachVerdict verdict_at(double tolerance, const PlacedPart& a, const PlacedPart& b, const PairReach& reach,
                        const ReachGoal& goal);

}  // namespace impinge::clash
