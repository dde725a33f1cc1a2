// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/judge.hpp"

#include <algorithm>
#include <cmath>

#include "clash/sheets/surface_crossing.hpp"
#include "clash/verdict.hpp"
#include "core/local_frame.hpp"
#include "exact/orientation.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

using solid::Cells;
using solid::kOutside;
using solid::kSameSide;

/// Whether the normals of two proper triangles in one plane point the same way.
bool have_one_normal(const Triangle& a, const Triangle& b) {
  const exact::Projection& p = exact::kProjections[static_cast<std::size_t>(exact::find_projection(a[0], a[1], a[2]))];
  return exact::orient2d(p, a[0], a[1], a[2]) == exact::orient2d(p, b[0], b[1], b[2]);
}

/// Judges one pair of parts under one tolerance.
class Case {
 public:
  Case(const MeasuredPart& a, const MeasuredPart& b, const JudgeGoal& goal)
      : measured_a_(a),
        measured_b_(b),
        a_(a.part),
        b_(b.part),
        goal_(goal),
        kinds_{a.part.solid, b.part.solid},
        thinnest_(thinnest(a, b)) {}

  Judgement judge() {
    if (!is_empty(a_.body.box) && !is_empty(b_.body.box)) decide();
    judgement_.counts = met_.counts, judgement_.contacts = std::move(met_.contacts);
    return std::move(judgement_);
  }

 private:
  void decide() {
    Judgement& j = judgement_;
    const double largest = std::max(largest_coordinate(a_.body.box), largest_coordinate(b_.body.box));
    j.tolerance = goal_.tolerance.value_or(0x1p-20 * largest);
    const bool is_asked = j.tolerance > 0;
    if (j.tolerance > thinnest_ / 4) j.tolerance = 0;
    met_ = find_contact_pairs(a_.body, b_.body, {j.tolerance, goal_.all_contacts, goal_.stop});
    if (goal_.stop.stop_requested() || (j.tolerance > 0 && judge_nearly()) || goal_.stop.stop_requested()) return;
    j.tolerance = 0;
    conclude(find_exactly(), !met_.contacts.empty());
    if (is_asked && met_.is_near()) j.note = Note::tolerance_not_applied;
  }

  /// The lesser thickness of the two parts: the thinnest wall of a solid, the extent of a surface.
  static double thinnest(const MeasuredPart& a, const MeasuredPart& b) {
    const auto thickness = [](const MeasuredPart& known) {
      const solid::Part& part = known.part;
      return part.solid ? known.thinnest_wall : norm(part.body.box.hi - part.body.box.lo);
    };
    return std::min(thickness(a), thickness(b));
  }

  [[nodiscard]] solid::Enough enough() const {
    return [this](const Cells& cells) { return is_settled(cells, kinds_) || goal_.stop.stop_requested(); };
  }

  void conclude(const Finding& finding, bool touch) {
    judgement_.verdict = finding.verdict, judgement_.inner = finding.inner, judgement_.touch = touch;
  }

  Finding find_exactly() {
    const Cells cells = solid::cells_of(a_, b_, met_.contacts, enough());
    const bool pass = !kinds_.a_is_solid && !kinds_.b_is_solid && surfaces_cross_exactly(a_, b_, met_.contacts);
    return verdict_of(cells, kinds_, !met_.contacts.empty(), pass);
  }
  bool is_exact(Verdict verdict) { return find_exactly().verdict == verdict; }

  /// Judges with the tolerance. False where floating point, or the deep points, cannot decide.
  bool judge_nearly() {
    const auto found = cells_within(a_, b_, {judgement_.tolerance, met_, enough(), goal_.stop});
    if (!found) return false;
    Cells cells = *found;
    if (kinds_.a_is_solid && kinds_.b_is_solid) {
      if (met_.is_near() && !is_settled(cells, kinds_) && !look_deep(cells)) return false;
    } else if (!kinds_.a_is_solid && !kinds_.b_is_solid && ((cells.a | cells.b) & kOutside) == 0) {
      cells.a |= kSameSide, cells.b |= kSameSide;
    }
    const bool pass =
        !kinds_.a_is_solid && !kinds_.b_is_solid && surfaces_cross(a_, b_, judgement_.tolerance, met_, goal_.stop);
    conclude(verdict_of(cells, kinds_, met_.is_near(), pass), met_.is_near());
    if (met_.is_near()) judgement_.note = note();
    return true;
  }

  /// Decides by deep points where the boundaries are near each other. If a point deep inside one solid is inside the
  /// other too, the near boundaries have both interiors on one side; if it is outside, the one solid is not inside the
  /// other. False if no point decides while all of both boundaries is near: the solids may be equal or lie side by
  /// side.
  bool look_deep(Cells& cells) const {
    constexpr std::uint8_t kFarOff = solid::kInside | kOutside;
    const Spread of_a = spread(measured_a_, b_), of_b = spread(measured_b_, a_);
    if (of_a.inside || of_b.inside) cells.a |= kSameSide, cells.b |= kSameSide;
    if (of_a.outside) cells.a |= kOutside;
    if (of_b.outside) cells.b |= kOutside;
    return of_a.inside || of_b.inside || ((cells.a | cells.b) & kFarOff) != 0;
  }

  Note note() {
    const Verdict verdict = judgement_.verdict;
    if (verdict == Verdict::penetrating || verdict == Verdict::crossing) return Note::none;
    if (verdict == Verdict::duplicate) return is_exact(verdict) ? Note::none : Note::equal_within_tolerance;
    if (met_.contacts.empty()) return verdict == Verdict::touching ? Note::gap_within_tolerance : Note::none;
    const Note differs = verdict == Verdict::inside ? Note::outside_within_tolerance : Note::overlap_within_tolerance;
    if (some_cross()) return differs;
    const auto overlap = [&](const exact::Contact& contact) { return has_interiors_on_one_side(contact); };
    if (verdict == Verdict::touching && std::any_of(met_.contacts.begin(), met_.contacts.end(), overlap))
      return differs;
    // Where meshes have edges along the line in which their boundaries cross, no pair of triangles crosses.
    const bool is_so = verdict == Verdict::touching && kinds_.a_is_solid && kinds_.b_is_solid
                           ? are_parted() || !solid::reach_into_each_other(a_, b_, met_.contacts)
                           : is_exact(verdict);
    return is_so ? Note::none : differs;
  }

  /// Whether the plane of some common area separates the two parts, as it does most flush parts.
  [[nodiscard]] bool are_parted() const {
    const auto& contacts = met_.contacts;
    const auto flush = std::find_if(contacts.begin(), contacts.end(),
                                    [](const exact::Contact& contact) { return contact.kind == Kind::coplanar; });
    if (flush == contacts.end()) return false;
    const Triangle plane = a_.body.triangle(flush->a);
    const auto sides_of = [&](const solid::Part& part) {
      int lo = 0, hi = 0;
      for (const Vec3& vertex : part.body.world) {
        const int side = exact::orient3d(plane[0], plane[1], plane[2], vertex);
        lo = std::min(lo, side), hi = std::max(hi, side);
        if (lo < hi - 1) break;
      }
      return std::pair(lo, hi);
    };
    const auto [lo_a, hi_a] = sides_of(a_);
    if (lo_a < 0 && hi_a > 0) return false;
    const auto [lo_b, hi_b] = sides_of(b_);
    return (lo_a >= 0 && hi_b <= 0) || (hi_a <= 0 && lo_b >= 0);
  }

  [[nodiscard]] bool some_cross() const { return met_.counts[static_cast<std::size_t>(Kind::crossing)] > 0; }

  [[nodiscard]] bool has_interiors_on_one_side(const exact::Contact& contact) const {
    if (contact.kind != Kind::coplanar || !kinds_.a_is_solid || !kinds_.b_is_solid) return false;
    const Triangle a = a_.body.triangle(contact.a), b = b_.body.triangle(contact.b);
    if (!exact::share_area(a, b)) return false;
    const auto front = [](const solid::Part& part, std::uint32_t t) {
      return part.sides[part.topology.shell[t]].front;
    };
    const bool same_way = have_one_normal(a, b);
    return (front(a_, contact.a) == front(b_, contact.b)) == same_way;
  }

  /// Whether some deep points of one solid are inside or outside of the other. Only points farther than the tolerance
  /// from both boundaries count.
  struct Spread {
    bool inside = false, outside = false;
  };
  [[nodiscard]] Spread spread(const MeasuredPart& one, const solid::Part& other) const {
    Spread spread;
    for (const DeepPoint& deep : one.deep_points) {
      if (spread.inside && spread.outside) break;
      if (deep.depth <= judgement_.tolerance ||
          measure::nearest_point(other.body.placed, deep.point, judgement_.tolerance, judgement_.tolerance, goal_.stop))
        continue;
      const bool is_inside = solid::winding_number(other.body.placed, deep.point).value_or(0) != 0;
      (is_inside ? spread.inside : spread.outside) = true;
    }
    return spread;
  }

  const MeasuredPart &measured_a_, &measured_b_;
  const solid::Part &a_, &b_;
  const JudgeGoal& goal_;
  Kinds kinds_;
  double thinnest_;
  ContactPairs met_;  ///< the pairs within the tolerance
  Judgement judgement_;
};

}  // namespace

Judgement judge_pair(const MeasuredPart& a, const MeasuredPart& b, const JudgeGoal& goal) {
  return Case(a, b, goal).judge();
}

}  // namespace impinge::clash
