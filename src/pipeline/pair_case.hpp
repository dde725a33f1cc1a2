// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "clash/depth.hpp"
#include "clash/judge.hpp"
#include "impinge/clash.hpp"
#include "pipeline/seen_part.hpp"

namespace impinge {

/// The verdicts on one pair of parts, and what else is asked for. What several terms have in common, or several pairs
/// of equal parts in the same places, is found once.
class PairCase {
 public:
  /// All must live as long as this.
  PairCase(const SeenPart& a, const SeenPart& b, const ClashOptions& options) : a_(a), b_(b), options_(options) {}

  Clash judge(const ClashTerms& terms);

 private:
  struct Found {
    std::optional<double> tolerance;
    clash::Judgement judgement;
    std::optional<std::vector<Region>> regions;
  };
  struct Near {
    double clearance;
    std::optional<Nearest> nearest;
  };

  Found& find(const std::optional<double>& tolerance);
  [[nodiscard]] std::optional<Nearest> nearest(double clearance) const;

  const SeenPart &a_, &b_;
  const ClashOptions& options_;
  std::vector<Found> found_;
  std::optional<Near> nearest_;
  std::optional<OverlapDepth> depth_;
};

/// How deep either closed part reaches into the other.
OverlapDepth find_depths(const SeenPart& a, const SeenPart& b, const clash::DepthGoal& goal);

}  // namespace impinge
