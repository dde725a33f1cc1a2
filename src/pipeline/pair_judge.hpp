// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clash/depth.hpp"
#include "clash/verdict.hpp"
#include "exact/contact.hpp"
#include "impinge/clash.hpp"
#include "impinge/contacts.hpp"
#include "pipeline/part.hpp"

namespace impinge {

/// Judges one pair of parts on any number of terms. Contacts, reach, regions and distances are computed once and shared
/// between them.
class PairJudge {
 public:
  /// The arguments must outlive the judge.
  PairJudge(const Part& a, const Part& b, const ClashOptions& options);

  /// What is said on each of the terms. Once it is stopped, the result is meaningless, or
  /// `Stopped` is thrown.
  std::vector<Clash> judge(std::span<const ClashTerms> terms);
  /// Why contacts could not be found, in which case the result is meaningless. Errors: as `collide`.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  /// The tolerance that a pair is judged at, and the one that its regions are found with.
  struct Applied {
    double tolerance = 0, of_regions = 0;
    bool is_raised = false;
    friend bool operator==(const Applied&, const Applied&) = default;
  };
  struct Found {
    Applied applied;
    Clash clash;  ///< without what the other terms decide
    std::optional<std::vector<Region>> regions;
  };
  struct Within {
    double clearance;
    std::optional<Nearest> nearest;
  };

  [[nodiscard]] Applied applied(const std::optional<double>& tolerance) const;
  [[nodiscard]] bool are_solid() const;
  [[nodiscard]] bool are_plain() const;
  Clash judge(const ClashTerms& terms);
  Found& find(const Applied& applied);
  [[nodiscard]] Clash find_exactly() const;
  [[nodiscard]] Clash find_within(const Applied& applied) const;
  [[nodiscard]] bool may_pass() const;
  void reach_for(std::span<const ClashTerms> terms);
  [[nodiscard]] std::vector<Region> find_regions(double tolerance) const;
  [[nodiscard]] std::optional<Nearest> nearest(double clearance) const;

  const Part &a_, &b_;
  const ClashOptions& options_;
  double largest_;  ///< |world coordinate|
  std::optional<Contacts> contacts_;
  std::optional<Error> error_;
  std::array<std::uint64_t, 3> counts_{};  ///< of contacts, by Kind
  std::vector<double> levels_;             ///< the tolerances that `reach_` was searched for
  std::optional<clash::PairReach> reach_;
  std::vector<Found> found_;
  std::optional<std::optional<OverlapVolume>> volume_;
  std::optional<Within> nearest_;
};

/// The contacts of an answer about two meshes.
std::vector<exact::Contact> exact_contacts(const Contacts& contacts);

/// The penetration depth of each closed part in the other.
OverlapDepth find_depths(const Part& a, const Part& b, const clash::DepthGoal& goal);

}  // namespace impinge
