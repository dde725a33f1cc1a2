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
using solid::kInside;
using solid::kNear;
using solid::kOtherSide;
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
      : a_(a.linked),
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
    judge_exactly();
    if (is_asked && !near_.empty()) j.note = Note::tolerance_not_applied;
  }

  /// A surface has no wall; there its extent stands for it.
  static double thinnest(const KnownPart& a, const KnownPart& b) {
    const auto thickness = [](const KnownPart& known) {
      const solid::Part& part = known.linked.part;
      return part.solid ? known.facts.wall : norm(part.body.box.hi - part.body.box.lo);
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

  void conclude(const Cells& cells, bool touch, bool pass) {
    const Finding finding = verdict_of(cells, kinds_, touch, pass);
    judgement_.verdict = finding.verdict, judgement_.inner = finding.inner, judgement_.touch = touch;
  }

  void judge_exactly() {
    const Cells cells = solid::cells_of(a_.part, b_.part, contacts(), enough());
    const bool crosses = std::any_of(contacts().begin(), contacts().end(), is_crossing);
    conclude(cells, !contacts().empty(), crosses);
  }

  /// False where floating point cannot tell.
  bool judge_nearly() {
    const auto found = near_cells(a_, b_, judgement_.tolerance, near_, enough());
    if (!found) return false;
    Cells cells = *found;
    if (((cells.a | cells.b) & kInside) == 0) {
      // What is near is shared: with both interiors on one side if deep within the one part lies the other too.
      const bool are_surfaces = !kinds_.a_is_solid && !kinds_.b_is_solid;
      const bool overlap = are_surfaces ? ((cells.a | cells.b) & kOutside) == 0 : overlap_deeply();
      if (!near_.empty() && (overlap || are_surfaces)) {
        if ((cells.a & kOutside) == 0) cells.a |= kSameSide;
        if ((cells.b & kOutside) == 0) cells.b |= kSameSide;
        if (!are_surfaces) cells.a |= kSameSide, cells.b |= kSameSide;
      }
    }
    const bool pass =
        !kinds_.a_is_solid && !kinds_.b_is_solid && pass_through(a_, b_, judgement_.tolerance, near_, contacts());
    conclude(cells, !near_.empty(), pass);
    if (!near_.empty()) judgement_.note = note();
    return true;
  }

  Note note() {
    const Verdict verdict = judgement_.verdict;
    if (verdict == Verdict::penetrating || verdict == Verdict::crossing) return Note::none;
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

  /// Whether some shell of the one encloses a point, farther than the tolerance from both boundaries, that lies in the
  /// other.
  [[nodiscard]] bool overlap_deeply() const {
    return kinds_.a_is_solid && kinds_.b_is_solid && (is_deep_in(a_.part, b_.part) || is_deep_in(b_.part, a_.part));
  }

  [[nodiscard]] bool is_deep_in(const solid::Part& one, const solid::Part& other) const {
    std::vector<bool> is_done(one.topology.shells, false);
    for (std::uint32_t t = 0; t < one.body.size(); ++t) {
      const std::uint32_t shell = one.topology.shell[t];
      if (shell == solid::Topology::kNoShell || is_done[shell]) continue;
      const auto point = point_below(one, t);
      if (!point) continue;
      is_done[shell] = true;
      if (!measure::nearest_point(other.body.placed, *point, judgement_.tolerance, judgement_.tolerance) &&
          solid::winding_number(other.body.placed, *point).value_or(0) != 0)
        return true;
    }
    return false;
  }

  /// An interior point behind a triangle's middle, farther than twice the tolerance from the boundary.
  [[nodiscard]] std::optional<Vec3> point_below(const solid::Part& part, std::uint32_t t) const {
    const Triangle triangle = part.body.triangle(t);
    const LocalFrame frame = local_frame(part.body.box, part.body.box);
    const Triangle local = frame.to_local(triangle);
    Vec3 normal = cross(local[1] - local[0], local[2] - local[0]);
    const double length = norm(normal);
    if (!(length > 0)) return std::nullopt;
    normal = (part.sides[part.topology.shell[t]].front ? 1 : -1) / length * normal;
    const Vec3 middle = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
    for (double step = norm(frame.unit * (part.body.box.hi - part.body.box.lo)) / frame.unit / 2;
         step > 2 * judgement_.tolerance; step /= 2) {
      const Vec3 point = middle + step * normal;
      if (!measure::nearest_point(part.body.placed, point, 2 * judgement_.tolerance, 2 * judgement_.tolerance) &&
          solid::winding_number(part.body.placed, point).value_or(0) != 0)
        return point;
    }
    return std::nullopt;
  }

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
