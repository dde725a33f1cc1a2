// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "clash/depth.hpp"
#include "clash/judge.hpp"
#include "impinge/clash.hpp"
#include "pipeline/part.hpp"

namespace impinge {

/// Judges one pair of parts under any number of tolerances. Contacts, regions, depths and distances are computed once
/// and shared between them.
class PairJudge {
 public:
  /// The arguments must outlive the judge.
  PairJudge(const Part& a, const Part& b, const ClashOptions& options) : a_(a), b_(b), options_(options) {}

  Clash judge(const ClashTerms& terms);

 private:
  struct Found {
    std::optional<double> tolerance;
    clash::Judgement judgement;
    std::optional<std::vector<Region>> regions;
  };
  struct Within {
    double clearance;
    std::optional<Nearest> nearest;
  };

  Found& find(const std::optional<double>& tolerance);
  [[nodiscard]] std::optional<Nearest> nearest(double clearance) const;

  const Part &a_, &b_;
  const ClashOptions& options_;
  std::vector<Found> found_;
  std::optional<Within> nearest_;
  std::optional<OverlapDepth> depth_;
};

/// The penetration depth of each closed part in the other.
OverlapDepth find_depths(const Part& a, const Part& b, const clash::DepthGoal& goal);

}  // namespace impinge
