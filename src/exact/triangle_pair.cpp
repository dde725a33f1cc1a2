// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/triangle_pair.hpp"

#include <utility>

#include "core/shapes.hpp"
#include "exact/filter.hpp"
#include "exact/integers.hpp"
#include "exact/segment.hpp"

namespace impinge::exact {
namespace {

/// Numbers of a triangle's vertices, as in PairSigns.
using Corners = std::array<int, 3>;
constexpr std::array<Corners, 2> kCorners{{{0, 1, 2}, {3, 4, 5}}};

int next(int corner) { return corner == 2 ? 0 : corner + 1; }

// Of sets of three corners that are not empty.
bool is_single(unsigned set) { return (set & (set - 1)) == 0; }
int lowest(unsigned set) { return std::array{0, 0, 1, 0, 2, 0, 1, 0}[set]; }
int highest(unsigned set) { return std::array{0, 0, 1, 1, 2, 2, 2, 2}[set]; }

/// Six points without one of their coordinates.
template <class Point>
class Flat {
 public:
  Flat(const std::array<Point, 6>& points, const Projection& p) {
    constexpr std::array kAxes{&Point::x, &Point::y, &Point::z};
    for (std::size_t i = 0; i < 6; ++i) u_[i] = points[i].*kAxes[p.u], v_[i] = points[i].*kAxes[p.v];
  }
  /// Of three points: +1 to the left, -1 to the right, 0 none.
  [[nodiscard]] int turn(int a, int b, int c) const { return orient2d(u_[a], v_[a], u_[b], v_[b], u_[c], v_[c]); }
  /// The triangle's vertices in the order in which they turn left.
  [[nodiscard]] Corners turning_left(int triangle) const {
    const Corners& t = kCorners[triangle];
    return turn(t[0], t[1], t[2]) > 0 ? t : Corners{t[0], t[2], t[1]};
  }

 private:
  std::array<decltype(Point::x), 6> u_, v_;
};

/// Decides a pair of triangles that floating point has left undecided. Points are `Vec3` or `IntVec`.
template <class Point>
class Decision {
 public:
  Decision(const std::array<Point, 6>& points, PairSigns signs) : points_(points), signs_(signs) {}

  /// `open` where a triangle is degenerate.
  Outcome outcome() {
    for (const int t : {0, 1}) {
      learn_sides(t);
      if (const Outcome known = outcome_of(signs_); known != Outcome::open) return known;
    }
    // A vertex out of the plane proves the plane's triangle proper.
    if ((signs_.on(1) == 7 && projection_of(0) < 0) || (signs_.on(0) == 7 && projection_of(1) < 0))
      return Outcome::open;
    const Position a = signs_.position(0), b = signs_.position(1);
    if (a == Position::inside) return are_apart_in_plane() ? Outcome::apart : Outcome::coplanar;
    if (a == Position::straddling && b == Position::straddling)
      return outcome_on_line([](const auto&... p) { return orient3d(p...); });
    return part_in_plane_meets(a == Position::straddling ? 1 : 0) ? Outcome::touching : Outcome::apart;
  }

  /// Both triangles straddle the other's plane, so each meets the common line in a proper interval, and the order of
  /// the intervals' ends is a sign of orient3d (Guigue and Devillers, "Fast and Robust Triangle-Triangle Overlap Test
  /// Using Orientation Predicates", 2003). Two ends coincide if and only if the sign is 0, for then the two edges lie
  /// in a plane that holds just one point of the line. Relative interiors meet if and only if the open intervals do.
  /// Open if the signs do not say.
  template <class Orient3d>
  [[nodiscard]] Outcome outcome_on_line(const Orient3d& sign) const {
    Corners a = lone_vertex_first(0), b = lone_vertex_first(1);
    // Turning a triangle over turns its plane over: bring both lone vertices to the positive side.
    if (!is_single(signs_.above(0))) std::swap(b[1], b[2]);
    if (!is_single(signs_.above(1))) std::swap(a[1], a[2]);
    const int first = sign(points_[a[0]], points_[a[1]], points_[b[0]], points_[b[1]]);
    if (first == 1) return Outcome::apart;
    const int second = sign(points_[a[0]], points_[a[2]], points_[b[0]], points_[b[2]]);
    if (second == -1) return Outcome::apart;
    if (first == kUnsure || second == kUnsure) return Outcome::open;
    return first < 0 && second > 0 ? Outcome::crossing : Outcome::touching;
  }

  [[nodiscard]] bool share_area() {
    learn_sides(0);
    if (signs_.position(0) != Position::inside || projection_of(0) < 0 || projection_of(1) < 0) return false;
    const Flat flat(points_, kProjections[projection_of(0)]);
    return !separation(flat, 0, true).separates && !separation(flat, 1, true).separates;
  }

 private:
  void learn_sides(int triangle) {
    const unsigned known = signs_.above(triangle) | signs_.below(triangle) | signs_.on(triangle);
    if (known == 7) return;
    const Corners &p = kCorners[1 - triangle], &t = kCorners[triangle];
    auto plane = plane_through(points_[p[0]], points_[p[1]], points_[p[2]]);
    for (int i = 0; i < 3; ++i) {
      if ((known >> i & 1) != 0) continue;
      const int side = plane.side(points_[t[i]]);
      const int where = side > 0 ? PairSigns::kAbove : side < 0 ? PairSigns::kBelow : PairSigns::kOn;
      signs_.set(PairSigns::side_bit(where, triangle, i), 1);
    }
  }

  /// A coordinate plane onto which the triangle projects without becoming a segment; -1 if it is one.
  [[nodiscard]] int projection_of(int triangle) const {
    if (const unsigned axis = signs_.normal(triangle); axis != 0) return static_cast<int>(axis) - 1;
    const Point &a = points_[3 * triangle], &b = points_[3 * triangle + 1], &c = points_[3 * triangle + 2];
    if (orient2d(a.y, a.z, b.y, b.z, c.y, c.z) != 0) return 0;
    if (orient2d(a.z, a.x, b.z, b.x, c.z, c.x) != 0) return 1;
    if (orient2d(a.x, a.y, b.x, b.y, c.x, c.y) != 0) return 2;
    return -1;
  }

  /// The triangle turned so that its first vertex lies alone strictly on one side.
  [[nodiscard]] Corners lone_vertex_first(int triangle) const {
    const unsigned above = signs_.above(triangle);
    const int i = lowest(is_single(above) ? above : signs_.below(triangle));
    const Corners& t = kCorners[triangle];
    return {t[i], t[next(i)], t[next(next(i))]};
  }

  struct Separation {
    bool separates;     ///< a line along an edge has all of the other triangle on its outer side
    bool holds_corner;  ///< some corner of the other triangle is on no edge's outer side
  };
  /// By the edges of a triangle; `weakly`: what touches a line is on its outer side too.
  [[nodiscard]] static Separation separation(const Flat<Point>& flat, int triangle, bool weakly) {
    const Corners t = flat.turning_left(triangle);
    const Corners& other = kCorners[1 - triangle];
    unsigned outside_some = 0;
    bool separates = false;
    for (int i = 0; i < 3; ++i) {
      unsigned outside = 0;
      for (int j = 0; j < 3; ++j) outside |= unsigned{flat.turn(t[i], t[next(i)], other[j]) < int{weakly}} << j;
      separates |= outside == 7;
      outside_some |= outside;
    }
    return {separates, outside_some != 7};
  }

  [[nodiscard]] bool are_apart_in_plane() const {
    const Flat flat(points_, kProjections[projection_of(0)]);
    const Separation by_a = separation(flat, 0, false);
    if (by_a.separates || by_a.holds_corner) return by_a.separates;
    return separation(flat, 1, false).separates;
  }

  /// A triangle that does not straddle the other's plane has a vertex or an edge in it: whether that meets the other.
  /// Separating axes in the plane: the edges of the sum of a triangle and a (mirrored) segment are parallel to the
  /// edges of the two, so closed sets that do not meet are separated strictly by a line along one of these four.
  [[nodiscard]] bool part_in_plane_meets(int triangle) const {
    const unsigned on = signs_.on(triangle);
    const int first = 3 * triangle + lowest(on), last = 3 * triangle + highest(on);
    const Flat flat(points_, kProjections[projection_of(1 - triangle)]);
    const Corners t = flat.turning_left(1 - triangle);
    for (int i = 0; i < 3; ++i) {
      const auto outside = [&](int vertex) { return flat.turn(t[i], t[next(i)], vertex) < 0; };
      if (outside(first) && outside(last)) return false;
    }
    const int side = flat.turn(first, last, t[0]);
    return side == 0 || side != flat.turn(first, last, t[1]) || side != flat.turn(first, last, t[2]);
  }

  const std::array<Point, 6>& points_;
  PairSigns signs_;
};

/// By floating point, the sides of a triangle's vertices that are not shared (those are in the plane).
void see_sides(const Triangle& t, const Triangle& plane, int triangle, PairSigns& signs) {
  const FilteredNormal normal(plane[1] - plane[0], plane[2] - plane[0]);
  signs.set(PairSigns::kNormal + 2 * (1 - triangle), normal.certain_axis());
  const unsigned shared = signs.shared();
  for (int i = 0; i < 3; ++i) {
    const unsigned here = triangle == 0 ? shared & 7U << 3 * i : shared & 0b001001001U << i;
    const int side = here != 0 ? 0 : normal.sign(t[i] - plane[0]);
    signs.set(PairSigns::side_bit(PairSigns::kAbove, triangle, i), side == 1);
    signs.set(PairSigns::side_bit(PairSigns::kBelow, triangle, i), side == -1);
    signs.set(PairSigns::side_bit(PairSigns::kOn, triangle, i), side == 0);
  }
}

unsigned shared_vertices(const Triangle& a, const Triangle& b) {
  unsigned shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) shared |= unsigned{a[i] == b[j]} << (3 * i + j);
  return shared;
}

using Points = std::array<Vec3, 6>;

Points points_of(const Triangle& a, const Triangle& b) { return {a[0], a[1], a[2], b[0], b[1], b[2]}; }

}  // namespace

Outcome decide(PairSigns signs, const std::array<IntVec, 6>& points) { return Decision(points, signs).outcome(); }
Outcome decide(PairSigns signs, const std::array<Vec3, 6>& points) { return Decision(points, signs).outcome(); }

Outcome decide_degenerate(const std::array<Vec3, 6>& points) {
  const Triangle a{points[0], points[1], points[2]}, b{points[3], points[4], points[5]};
  const bool meet = is_proper(a)   ? intersects(extremes(b), a)
                    : is_proper(b) ? intersects(extremes(a), b)
                                   : intersects(extremes(a), extremes(b));
  return meet ? Outcome::touching : Outcome::apart;
}

std::optional<Kind> classify(const Triangle& a, const Triangle& b) {
  if (!overlap(box_of(a), box_of(b))) return std::nullopt;
  PairSigns signs;
  signs.set(PairSigns::kShared, shared_vertices(a, b));
  see_sides(a, b, 0, signs);
  if (signs.position(0) == Position::beyond) return std::nullopt;
  see_sides(b, a, 1, signs);
  Outcome outcome = outcome_of(signs);
  if (outcome != Outcome::open) return kind_of(outcome);
  const Points points = points_of(a, b);
  const auto straddles = [&](int t) { return signs.position(t) == Position::straddling && signs.knows_sides(t); };
  if (straddles(0) && straddles(1)) outcome = Decision(points, signs).outcome_on_line(filtered_orient3d);
  if (outcome == Outcome::open) {
    std::array<IntVec, 6> integers;
    outcome = to_integers(points, integers.data()) ? decide(signs, integers) : decide(signs, points);
    if (outcome == Outcome::open) outcome = decide_degenerate(points);
  }
  return kind_of(outcome);
}

bool share_area(const Triangle& a, const Triangle& b) {
  const Points points = points_of(a, b);
  std::array<IntVec, 6> integers;
  return to_integers(points, integers.data()) ? Decision(integers, {}).share_area() : Decision(points, {}).share_area();
}

}  // namespace impinge::exact
