// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/touch_search.hpp"

#include <utility>

#include "exact/settle.hpp"

namespace impinge {

void TouchSearch::run_slices(const FastStages::Pair& pair, bool may_share, const std::stop_token& stop,
                             StageClock& clock, Statistics& counts) {
  stack_.clear();
  for (bool fresh = true; (fresh || !stack_.empty()) && !stop.stop_requested(); fresh = false) {
    stages_.run_slice(pair, fresh, stack_, clock, counts);
    if (!stages_.contacts().empty() || (may_share && stages_.is_worth_sharing())) break;
  }
}

std::optional<TrianglePair> TouchSearch::find(const PlacedMesh& first, const PlacedMesh& second) {
  stages_.configure(Options::Find::first, kAllKinds);
  run_slices({first, second, {}}, false, stop_, clock_, statistics_);
  if (stages_.contacts().empty()) return std::nullopt;
  const results::ContactKey found = stages_.contacts().front();
  return TrianglePair{results::triangle_a(found), results::triangle_b(found)};
}

void TouchSearch::begin(const FastStages::Pair& pair, const Options& options, StageClock clock, Statistics& counts) {
  stages_.configure(options.find, options.kinds);
  run_slices(pair, options.threads != 1, options.stop, clock, counts);
}

bool TouchSearch::is_contact(const PlacedMesh& first, const PlacedMesh& second, const TrianglePair& triangles) {
  contacts_.clear();
  const bool is_outside_exact_domain = first.object.is_outside_exact_domain || second.object.is_outside_exact_domain;
  (is_outside_exact_domain ? exact::settle_one_by_one : exact::settle)(
      *first.object.mesh, first.object.pose, *second.object.mesh, second.object.pose, {&triangles, 1}, contacts_);
  return !contacts_.empty();
}

}  // namespace impinge
