// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "clash/reach.hpp"
#include "impinge/clash.hpp"
#include "solid/cells.hpp"

namespace impinge::clash {

/// What is said of a pair at a tolerance.
struct Judgement {
  Verdict verdict = Verdict::apart;
  int inner = -1;          ///< with `inside`: which of the two
  bool undecided = false;  ///< the upper ends of the depths would say that it fails
};

/// `reach` is that of the two parts; it decides whether the pair fails, and only the name of what fails needs more.
/// `share_point`: it is known that they do.
Judgement verdict_at(double tolerance, const PlacedPart& a, const PlacedPart& b, const PairReach& reach,
                     bool share_point, const std::stop_token& stop = {});

/// The verdict on two closed parts without tolerance, which follows from where the cells of either boundary are
/// (docs/verdicts.md).
Judgement exact_verdict(const solid::Cells& cells, bool share_point);

/// Whether no further cell could change that verdict.
bool is_settled(const solid::Cells& cells);

}  // namespace impinge::clash
