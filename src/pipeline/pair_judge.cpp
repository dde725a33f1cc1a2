// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/pair_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clash/overlap_volume.hpp"
#include "clash/regions/regions.hpp"
#include "core/local_frame.hpp"
#include "exact/orientation.hpp"
#include "impinge/collide.hpp"
#include "measure/nearest.hpp"
#include "solid/cells.hpp"

namespace impinge {
namespace {

/// The contacts of the boundaries that exact cells are found in; none once it is stopped.
std::vector<exact::Contact> exact_contacts(const Part& a, const Part& b, const std::stop_token& stop) {
  const auto boundary = [](const Part& part) -> const Mesh& {
    return part.found->boundary ? *part.found->boundary : *part.mesh;
  };
  const auto found = collide(boundary(a), a.pose, boundary(b), b.pose, {.threads = 1, .stop = stop});
  return found ? exact_contacts(*found) : std::vector<exact::Contact>();
}

}  // namespace

std::vector<exact::Contact> exact_contacts(const Contacts& contacts) {
  std::vector<exact::Contact> result;
  result.reserve(contacts.triangles.size());
  for (std::size_t i = 0; i < contacts.triangles.size(); ++i)
    result.push_back({contacts.triangles[i].a, contacts.triangles[i].b, contacts.kinds[i]});
  return result;
}

OverlapDepth find_depths(const Part& a, const Part& b, const clash::DepthGoal& goal) {
  const solid::Body &body_a = a.placed.whole, &body_b = b.placed.whole;
  const ExactPart &exact_a = a.exact(goal.stop), &exact_b = b.exact(goal.stop);
  if (exact_a.is_plain && exact_b.is_plain)
    return clash::depths_of(exact_a.part, exact_b.part, exact_contacts(a, b, goal.stop), goal);
  return {clash::depth_in(body_a, body_b, goal), clash::depth_in(body_b, body_a, goal)};
}

PairJudge::PairJudge(const Part& a, const Part& b, const ClashOptions& options)
    : a_(a),
      b_(b),
      options_(options),
      largest_(std::max(largest_coordinate(a.placed.whole.box), largest_coordinate(b.placed.whole.box))) {}

std::vector<Clash> PairJudge::judge(std::span<const ClashTerms> terms) {
  std::vector<Clash> clashes;
  if (a_.placed.whole.size() == 0 || b_.placed.whole.size() == 0) {
    for (const ClashTerms& each : terms) clashes.push_back({.test = each.test});
    return clashes;
  }
  if (!contacts_) {
    auto found = collide(*a_.mesh, a_.pose, *b_.mesh, b_.pose,
                         {.limit = kMostContacts, .threads = 1, .backend = options_.backend, .stop = options_.stop});
    if (!found && found.error().code != Code::cancelled) error_ = found.error();
    contacts_ = found ? *std::move(found) : Contacts();
    for (const Kind kind : contacts_->kinds) ++counts_[static_cast<std::size_t>(kind)];
  }
  reach_for(terms);
  for (const ClashTerms& each : terms) clashes.push_back(judge(each));
  return clashes;
}

/// The reach is searched for anew where a tolerance was not thought of before.
void PairJudge::reach_for(std::span<const ClashTerms> terms) {
  const std::size_t known = levels_.size();
  for (const ClashTerms& each : terms) {
    const double level = applied(each.tolerance).tolerance;
    if (std::find(levels_.begin(), levels_.end(), level) == levels_.end()) levels_.push_back(level);
  }
  if (reach_ && levels_.size() == known) return;
  // A depth that the tolerance excuses is told if it is more than rounding.
  const double rounding = applied({}).tolerance;
  if (std::isfinite(options_.depth_precision) && std::find(levels_.begin(), levels_.end(), rounding) == levels_.end())
    levels_.push_back(rounding);
  std::sort(levels_.begin(), levels_.end());
  reach_ = clash::reach_between(a_.placed, b_.placed,
                                {.precision = options_.depth_precision, .levels = levels_, .stop = options_.stop});
}

Clash PairJudge::judge(const ClashTerms& terms) {
  Found& found = find(applied(terms.tolerance));
  Clash clash = found.clash;
  clash.test = terms.test;
  if (clash.verdict > terms.last) return clash;
  if (terms.clearance > 0 && contacts_->triangles.empty()) {
    if (!nearest_ || nearest_->clearance != terms.clearance)
      nearest_ = Within{terms.clearance, nearest(terms.clearance)};
    clash.nearest = nearest_->nearest;
  }
  const bool overlap = clash.verdict < Verdict::touching || clash.note == Note::overlap_within_tolerance;
  if (options_.volumes && overlap && are_solid()) {
    if (!volume_) volume_ = clash::overlap_volume(a_.placed, b_.placed, options_.stop);
    clash.overlap_volume = *volume_;
  }
  if (options_.regions && clash.verdict != Verdict::apart) {
    if (!found.regions) found.regions = find_regions(found.applied.of_regions);
    clash.regions = *found.regions;
  }
  return clash;
}

/// Whether all pieces of both are.
bool PairJudge::are_solid() const {
  const auto is_solid = [](const Part& part) {
    const std::array<std::uint32_t, 3>& pieces = part.facts.pieces;
    return pieces[0] > 0 && pieces[1] == 0 && pieces[2] == 0;
  };
  return is_solid(a_) && is_solid(b_);
}

bool PairJudge::are_plain() const {
  return are_solid() && a_.exact(options_.stop).is_plain && b_.exact(options_.stop).is_plain;
}

/// Coordinates are doubles with 53 bits, of which sums and products in a few steps leave some 42. Outlines of regions
/// are told less finely than depths: far from the origin the automatic tolerance is too small for them.
PairJudge::Applied PairJudge::applied(const std::optional<double>& tolerance) const {
  const double least = 0x1p-42 * largest_;
  if (!tolerance) {
    const double rounding = a_.rounding + b_.rounding + 2 * least;
    return {rounding, std::max(rounding, 0x1p-20 * largest_), false};
  }
  const bool is_raised = *tolerance < least && !(*tolerance == 0 && are_plain());
  const double at = is_raised ? least : *tolerance;
  return {at, at, is_raised};
}

/// Keeps the results for the last 16 tolerances: callers use few, unless every pair has a tolerance of its own.
PairJudge::Found& PairJudge::find(const Applied& applied) {
  constexpr std::size_t kMost = 16;
  for (Found& known : found_)
    if (known.applied == applied) return known;
  if (found_.size() == kMost) found_.clear();
  Clash clash = applied.tolerance == 0 ? find_exactly() : find_within(applied);
  clash.tolerance = applied.tolerance, clash.contacts = counts_;
  if (!std::isfinite(options_.depth_precision)) {
    clash.fails_below = clash.verdict < Verdict::touching ? std::numeric_limits<double>::infinity() : 0;
  } else if ((a_.placed.has_inside() || b_.placed.has_inside()) &&
             (clash.fails_below > 0 || clash.note == Note::undecided)) {
    clash.overlap_depth = OverlapDepth{reach_->a_in_b, reach_->b_in_a};
  }
  return found_.emplace_back(Found{applied, std::move(clash), {}});
}

Clash PairJudge::find_exactly() const {
  const auto enough = [&](const solid::Cells& cells) {
    return clash::is_settled(cells) || options_.stop.stop_requested();
  };
  const solid::Cells cells = solid::cells_of(a_.exact(options_.stop).part, b_.exact(options_.stop).part,
                                             exact_contacts(a_, b_, options_.stop), enough);
  const clash::Judgement judgement = clash::exact_verdict(cells, !contacts_->triangles.empty());
  Clash clash{.verdict = judgement.verdict, .inner = judgement.inner};
  if (clash.verdict < Verdict::touching)
    clash.fails_below = std::max(reach_->fails_below(), std::numeric_limits<double>::denorm_min());
  return clash;
}

Clash PairJudge::find_within(const Applied& applied) const {
  const bool share_point = !contacts_->triangles.empty();
  const clash::Judgement judgement =
      clash::verdict_at(applied.tolerance, a_.placed, b_.placed, *reach_, share_point, options_.stop);
  Clash clash{.verdict = judgement.verdict, .inner = judgement.inner};
  clash.fails_below = reach_->fails_below();
  const bool both = a_.placed.has_inside() && b_.placed.has_inside();
  const bool none = !a_.placed.has_inside() && !b_.placed.has_inside();
  if (applied.is_raised) {
    clash.note = Note::tolerance_raised;
  } else if (judgement.undecided || (judgement.verdict == Verdict::touching && none && may_pass())) {
    clash.note = Note::undecided;
  } else if (judgement.verdict == Verdict::touching) {
    const bool overlap = clash.fails_below > 0 || (both && counts_[static_cast<std::size_t>(Kind::crossing)] > 0);
    clash.note = overlap ? Note::overlap_within_tolerance : share_point ? Note::none : Note::gap_within_tolerance;
  }
  return clash;
}

/// Whether two surfaces may pass through each other: triangles of one cross a triangle of the other, or touch it from
/// both sides.
bool PairJudge::may_pass() const {
  if (counts_[static_cast<std::size_t>(Kind::crossing)] > 0) return true;
  struct Touched {
    std::uint32_t triangle, by;
  };
  const solid::Body &a = a_.placed.whole, &b = b_.placed.whole;
  const auto from_both_sides = [](const solid::Body& one, const solid::Body& other, std::vector<Touched>& touched) {
    std::sort(touched.begin(), touched.end(), [](const auto& x, const auto& y) { return x.triangle < y.triangle; });
    bool above = false, below = false;
    for (std::size_t i = 0; i < touched.size(); ++i) {
      if (i > 0 && touched[i].triangle != touched[i - 1].triangle) above = below = false;
      const Triangle plane = one.triangle(touched[i].triangle);
      for (const Vec3& vertex : other.triangle(touched[i].by)) {
        const int side = exact::orient3d(plane[0], plane[1], plane[2], vertex);
        above = above || side > 0, below = below || side < 0;
      }
      if (above && below) return true;
    }
    return false;
  };
  std::vector<Touched> of_a, of_b;
  for (const TrianglePair& pair : contacts_->triangles)
    of_a.push_back({pair.a, pair.b}), of_b.push_back({pair.b, pair.a});
  return from_both_sides(a, b, of_a) || from_both_sides(b, a, of_b);
}

std::vector<Region> PairJudge::find_regions(double tolerance) const {
  const solid::Part &a = a_.whole(), &b = b_.whole();
  std::optional<std::vector<exact::Contact>> within;
  if (tolerance > 0)
    within = clash::contacts_within(a.body, b.body, tolerance, clash::most_small_pairs(a.body, b.body), options_.stop);
  return clash::regions_of(a, b, within ? *within : exact_contacts(*contacts_), within ? tolerance : 0, {},
                           options_.stop);
}

std::optional<Nearest> PairJudge::nearest(double clearance) const {
  const auto near =
      measure::nearest_pair(a_.placed.whole.placed, b_.placed.whole.placed, clearance, 0, {.stop = options_.stop});
  if (!near || near->distance >= clearance) return std::nullopt;
  return Nearest{near->distance, near->error, near->a, near->b, near->triangle_a, near->triangle_b};
}

}  // namespace impinge
