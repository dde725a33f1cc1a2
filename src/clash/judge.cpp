// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/judge.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clash/local_frame.hpp"
#include "clash/passing.hpp"
#include "clash/verdict.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

using solid::Cells;
using solid::kOutside;
using solid::kSameSide;

std::vector<TrianglePair> near_pairs(const solid::Body& a, const solid::Body& b, double within) {
  std::vector<TrianglePair> near;
  measure::near_pairs(a.placed, b.placed, within, near);
  std::sort(near.begin(), near.end(),
            [](const TrianglePair& p, const TrianglePair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  return near;
}

std::vector<exact::Contact> touching_of(const solid::Body& a, const solid::Body& b,
                                        const std::vector<TrianglePair>& near) {
  std::vector<exact::Contact> contacts;
  for (const TrianglePair& pair : near)
    if (const auto kind = exact::classify(a.triangle(pair.a), b.triangle(pair.b)))
      contacts.push_back({pair.a, pair.b, *kind});
  return contacts;
}

/// Whether the normals of two proper triangles in one plane point the same way.
bool have_one_normal(const Triangle& a, const Triangle& b) {
  const exact::Projection& p = exact::kProjections[static_cast<std::size_t>(exact::find_projection(a[0], a[1], a[2]))];
  return exact::orient2d(p, a[0], a[1], a[2]) == exact::orient2d(p, b[0], b[1], b[2]);
}

/// One pair of parts on its way to a verdict.
class Case {
 public:
  Case(const KnownPart& a, const KnownPart& b, const std::stop_token& stop)
      : known_a_(a),
        known_b_(b),
        a_(a.linked),
        b_(b.linked),
        stop_(stop),
        kinds_{a.linked.part.solid, b.linked.part.solid},
        thinnest_(thinnest(a, b)) {}

  Judgement judge(std::optional<double> tolerance) {
    if (!is_empty(a_.part.body.box) && !is_empty(b_.part.body.box)) decide(tolerance);
    if (!near_.empty()) judgement_.contacts = std::move(contacts());
    return std::move(judgement_);
  }

 private:
  void decide(std::optional<double> tolerance) {
    Judgement& j = judgement_;
    const double largest = std::max(largest_coordinate(a_.part.body.box), largest_coordinate(b_.part.body.box));
    j.tolerance = tolerance.value_or(0x1p-20 * largest);
    const bool is_asked = j.tolerance > 0;
    if (j.tolerance > thinnest_ / 4) j.tolerance = 0;
    near_ = near_pairs(a_.part.body, b_.part.body, j.tolerance);
    if (j.tolerance > 0 && judge_nearly()) return;
    j.tolerance = 0;
    conclude(find_exactly(), !contacts().empty());
    if (is_asked && !near_.empty()) j.note = Note::tolerance_not_applied;
  }

  /// A surface has no wall; there its extent stands for it.
  static double thinnest(const KnownPart& a, const KnownPart& b) {
    const auto thickness = [](const KnownPart& known) {
      const solid::Part& part = known.linked.part;
      return part.solid ? known.thinnest_wall : norm(part.body.box.hi - part.body.box.lo);
    };
    return std::min(thickness(a), thickness(b));
  }

  /// Of the near pairs, those that share a point: looked for when first asked.
  std::vector<exact::Contact>& contacts() {
    if (!contacts_) contacts_ = touching_of(a_.part.body, b_.part.body, near_);
    return *contacts_;
  }

  [[nodiscard]] solid::Enough enough() const {
    return [this](const Cells& cells) { return is_settled(cells, kinds_) || stop_.stop_requested(); };
  }

  void conclude(const Finding& finding, bool touch) {
    judgement_.verdict = finding.verdict, judgement_.inner = finding.inner, judgement_.touch = touch;
  }

  Finding find_exactly() {
    const Cells cells = solid::cells_of(a_.part, b_.part, contacts(), enough());
    const bool pass = !kinds_.a_is_solid && !kinds_.b_is_solid && pass_exactly(a_.part, b_.part, contacts());
    return verdict_of(cells, kinds_, !contacts().empty(), pass);
  }
  bool is_exact(Verdict verdict) { return find_exactly().verdict == verdict; }

  /// False where floating point cannot tell.
  bool judge_nearly() {
    const auto found = near_cells(a_, b_, judgement_.tolerance, near_, enough());
    if (!found) return false;
    Cells cells = *found;
    if (kinds_.a_is_solid && kinds_.b_is_solid) {
      if (!near_.empty() && !is_settled(cells, kinds_)) look_deep(cells);
    } else if (!kinds_.a_is_solid && !kinds_.b_is_solid && ((cells.a | cells.b) & kOutside) == 0) {
      cells.a |= kSameSide, cells.b |= kSameSide;
    }
    const bool pass = !kinds_.a_is_solid && !kinds_.b_is_solid && pass_through(a_, b_, judgement_.tolerance, near_);
    conclude(verdict_of(cells, kinds_, !near_.empty(), pass), !near_.empty());
    if (!near_.empty()) judgement_.note = note();
    return true;
  }

  /// What is near is shared: with both interiors on one side if somewhere deep within the one part lies the other too.
  /// And what lies deep within one and outside of the other is not inside of it, wherever its boundary is near.
  void look_deep(Cells& cells) const {
    const Spread of_a = spread(known_a_, b_.part), of_b = spread(known_b_, a_.part);
    if (of_a.inside || of_b.inside) cells.a |= kSameSide, cells.b |= kSameSide;
    if (of_a.outside) cells.a |= kOutside;
    if (of_b.outside) cells.b |= kOutside;
  }

  Note note() {
    const Verdict verdict = judgement_.verdict;
    if (verdict == Verdict::penetrating || verdict == Verdict::crossing) return Note::none;
    if (verdict == Verdict::duplicate) return is_exact(verdict) ? Note::none : Note::equal_within_tolerance;
    if (contacts().empty()) return verdict == Verdict::touching ? Note::gap_within_tolerance : Note::none;
    const bool overlap = std::any_of(contacts().begin(), contacts().end(), [&](const exact::Contact& contact) {
      return is_crossing(contact) || (verdict == Verdict::touching && has_interiors_on_one_side(contact));
    });
    return overlap ? Note::overlap_within_tolerance : Note::none;
  }

  static bool is_crossing(const exact::Contact& contact) { return contact.kind == Kind::crossing; }

  [[nodiscard]] bool has_interiors_on_one_side(const exact::Contact& contact) const {
    if (contact.kind != Kind::coplanar || !kinds_.a_is_solid || !kinds_.b_is_solid) return false;
    const Triangle a = a_.part.body.triangle(contact.a), b = b_.part.body.triangle(contact.b);
    if (!exact::share_area(a, b)) return false;
    const auto front = [](const LinkedPart& part, std::uint32_t t) {
      return part.part.sides[part.part.topology.shell[t]].front;
    };
    const bool same_way = have_one_normal(a, b);
    return (front(a_, contact.a) == front(b_, contact.b)) == same_way;
  }

  /// Where points deep within one solid are to the other, of those that tell: farther than the tolerance from either's
  /// boundary.
  struct Spread {
    bool inside = false, outside = false;
  };
  [[nodiscard]] Spread spread(const KnownPart& one, const solid::Part& other) const {
    Spread spread;
    for (const DeepPoint& deep : one.deep_points) {
      if (spread.inside && spread.outside) break;
      if (deep.depth <= judgement_.tolerance ||
          measure::nearest_point(other.body.placed, deep.point, judgement_.tolerance, judgement_.tolerance))
        continue;
      const bool is_inside = solid::winding_number(other.body.placed, deep.point).value_or(0) != 0;
      (is_inside ? spread.inside : spread.outside) = true;
    }
    return spread;
  }

  const KnownPart &known_a_, &known_b_;
  const LinkedPart &a_, &b_;
  const std::stop_token& stop_;
  Kinds kinds_;
  double thinnest_;
  std::vector<TrianglePair> near_;  ///< within the tolerance, sorted
  std::optional<std::vector<exact::Contact>> contacts_;
  Judgement judgement_;
};

}  // namespace

Judgement judge_pair(const KnownPart& a, const KnownPart& b, std::optional<double> tolerance,
                     const std::stop_token& stop) {
  return Case(a, b, stop).judge(tolerance);
}

std::vector<exact::Contact> contacts_of(const solid::Body& a, const solid::Body& b) {
  return touching_of(a, b, near_pairs(a, b, 0));
}

}  // namespace impinge::clash
