// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/touch_search.hpp"

#include <utility>

#include "exact/settle.hpp"

namespace impinge {

TouchSearch::TouchSearch(std::stop_token stop) : stop_(std::move(stop)) {
  stages_.configure({.find = Options::Find::first});
}

std::optional<TrianglePair> TouchSearch::find(const PlacedMesh& first, const PlacedMesh& second) {
  const FastStages::Pair pair(first, second, {});
  stack_.clear();
  for (bool fresh = true; (fresh || !stack_.empty()) && !stop_.stop_requested(); fresh = false) {
    stages_.run_slice(pair, fresh, stack_, clock_, statistics_);
    if (stages_.contacts().empty()) continue;
    const results::ContactKey found = stages_.contacts().front();
    return TrianglePair{results::triangle_a(found), results::triangle_b(found)};
  }
  return std::nullopt;
}

bool TouchSearch::is_contact(const PlacedMesh& first, const PlacedMesh& second, const TrianglePair& triangles) {
  contacts_.clear();
  const bool is_outside_exact_domain = first.object.is_outside_exact_domain || second.object.is_outside_exact_domain;
  (is_outside_exact_domain ? exact::settle_one_by_one : exact::settle)(
      *first.object.mesh, first.object.pose, *second.object.mesh, second.object.pose, {&triangles, 1}, contacts_);
  return !contacts_.empty();
}

}  // namespace impinge
