// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/pair_judge.hpp"

#include <utility>

#include "clash/regions/regions.hpp"
#include "measure/nearest.hpp"
#include "solid/locate.hpp"

namespace impinge {
namespace {

std::vector<Region> find_regions(const solid::Part& a, const solid::Part& b, const clash::Judgement& judgement,
                                 const std::stop_token& stop) {
  const double tolerance = judgement.tolerance;
  std::optional<std::vector<exact::Contact>> within;
  if (tolerance > 0)
    within = clash::contacts_within(a.body, b.body, tolerance, clash::most_small_pairs(a.body, b.body), stop);
  auto regions = clash::regions_of(a, b, within ? *within : judgement.contacts, within ? tolerance : 0, {}, stop);
  return regions ? *std::move(regions) : std::vector<Region>();
}

}  // namespace

OverlapDepth find_depths(const Part& a, const Part& b, const clash::DepthGoal& goal) {
  const solid::Part &part_a = a.judged.part, &part_b = b.judged.part;
  if (part_a.solid && part_b.solid)
    return clash::depths_of(part_a, part_b,
                            clash::find_contact_pairs(part_a.body, part_b.body, {.stop = goal.stop}).contacts, goal);
  return {clash::depth_in(part_a.body, part_b.body, goal), clash::depth_in(part_b.body, part_a.body, goal)};
}

Clash PairJudge::judge(const ClashTerms& terms) {
  Clash clash;
  clash.test = terms.test;
  Found& found = find(terms.tolerance);
  const clash::Judgement& judgement = found.judgement;
  clash.verdict = judgement.verdict, clash.inner = judgement.inner;
  clash.note = judgement.note, clash.tolerance = judgement.tolerance;
  if (clash.verdict > terms.last) return clash;
  clash.contacts = judgement.counts;
  if (terms.clearance > 0 && !judgement.touch) {
    if (!nearest_ || nearest_->clearance != terms.clearance)
      nearest_ = Within{terms.clearance, nearest(terms.clearance)};
    clash.nearest = nearest_->nearest;
  }
  const bool overlap = clash.verdict == Verdict::penetrating || clash.verdict == Verdict::inside;
  if (options_.depth && overlap && a_.judged.facts.solid && b_.judged.facts.solid) {
    if (!depth_) depth_ = find_depths(a_, b_, clash::DepthGoal{.stop = options_.stop});
    clash.overlap_depth = depth_;
  }
  if (options_.regions && clash.verdict != Verdict::apart) {
    if (!found.regions) found.regions = find_regions(a_.whole(), b_.whole(), judgement, options_.stop);
    clash.regions = *found.regions;
  }
  return clash;
}

/// Keeps the results for the last 16 tolerances: callers use few, unless every pair has a tolerance of its own.
PairJudge::Found& PairJudge::find(const std::optional<double>& tolerance) {
  constexpr std::size_t kMost = 16;
  for (Found& known : found_)
    if (known.tolerance == tolerance) return known;
  if (found_.size() == kMost) found_.clear();
  Found& found = found_.emplace_back(
      Found{tolerance, clash::judge_pair(a_.judged, b_.judged, {tolerance, options_.regions, options_.stop}), {}});
  if (a_.with_walls || b_.with_walls) {
    clash::ContactPairs pairs =
        clash::find_contact_pairs(a_.whole().body, b_.whole().body, {0, options_.regions, options_.stop});
    found.judgement.counts = pairs.counts, found.judgement.contacts = std::move(pairs.contacts);
  }
  return found;
}

std::optional<Nearest> PairJudge::nearest(double clearance) const {
  const auto near =
      measure::nearest_pair(a_.whole().body.placed, b_.whole().body.placed, clearance, 0, {.stop = options_.stop});
  if (!near || near->distance >= clearance) return std::nullopt;
  return Nearest{near->distance, near->error, near->a, near->b, near->triangle_a, near->triangle_b};
}

}  // namespace impinge
