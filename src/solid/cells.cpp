// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/cells.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "exact/triangle_pair.hpp"
#include "solid/cut_triangle.hpp"
#include "solid/locate.hpp"
#include "solid/triangles.hpp"

namespace impinge::solid {
namespace {

/// A pair of boundary triangles that share a point; `own` belongs to the part whose cells are located.
struct Touch {
  std::uint32_t own, other;
  Kind kind;
  bool shares_area;
};

std::vector<Touch> touches_of(const Part& a, const Part& b, std::span<const exact::Contact> contacts) {
  std::vector<Touch> touches;
  for (const exact::Contact& contact : contacts) {
    if (!a.is_boundary(contact.a) || !b.is_boundary(contact.b)) continue;
    const bool shares_area =
        contact.kind == Kind::coplanar && exact::share_area(a.body.triangle(contact.a), b.body.triangle(contact.b));
    touches.push_back({contact.a, contact.b, contact.kind, shares_area});
  }
  return touches;
}

std::vector<Touch> turned(std::vector<Touch> touches) {
  for (Touch& touch : touches) std::swap(touch.own, touch.other);
  return touches;
}

/// The bit of the area that two triangles share. A side is +1 if the interior is where the normal points to.
Where shared_cell(const Part& a, const Part& b, const Touch& touch) {
  const int side_a = a.sides[a.topology.shell[touch.own]].front ? 1 : -1;
  const int side_b = b.sides[b.topology.shell[touch.other]].front ? 1 : -1;
  const bool turned = !same_orientation(a.body.triangle(touch.own), b.body.triangle(touch.other));
  return (side_a == side_b) != turned ? kSameSide : kOtherSide;
}

/// Finds which cells of one part's boundary lie inside or outside of the other part. Common cells are known already.
///
/// Only boundary triangles of either part count. An internal wall of the other part has the inside, or the outside, on
/// both sides: a point on it is located by a point beside it.
class Located {
 public:
  Located(const Part& own, const Part& other, std::vector<Touch> touches)
      : own_(own), other_(other), touches_(std::move(touches)), groups_(own.topology.positions) {
    std::sort(touches_.begin(), touches_.end(),
              [](const Touch& p, const Touch& q) { return std::pair(p.own, p.other) < std::pair(q.own, q.other); });
    for (std::size_t first = 0, last = 0; first < touches_.size(); first = last) {
      while (last < touches_.size() && touches_[last].own == touches_[first].own) ++last;
      touched_.push_back({touches_[first].own, std::span(touches_).subspan(first, last - first)});
    }
  }

  /// Locates the untouched triangles, which share no point with the other boundary. A connected patch of them does not
  /// either, so that one of its vertices locates all of it.
  template <class Enough>
  void locate_patches(const Enough& enough) {
    const auto each_untouched = [&](const auto& take) {
      std::size_t next = 0;
      for (std::uint32_t t = 0; t < own_.body.size(); ++t) {
        const bool is_touched = next < touched_.size() && touched_[next].triangle == t;
        next += is_touched ? 1 : 0;
        if (!is_touched && own_.is_boundary(t) && !take(t)) return;
      }
    };
    each_untouched([&](std::uint32_t t) {
      const auto [p, q, r] = own_.corners(t);
      groups_.join(p, q), groups_.join(p, r);
      return true;
    });
    of_group_.assign(own_.topology.positions, kUnknown);
    each_untouched([&](std::uint32_t t) {
      bits_ |= location_of_vertex(t, 0);
      return !enough();
    });
  }

  /// Locates the vertices of touched triangles: around a vertex that is not on the other boundary, the cells of its
  /// triangles lie where the vertex does. A triangle with such a vertex that no other triangle cuts is done.
  template <class Enough>
  void locate_vertices(const Enough& enough) {
    for (Touched& t : touched_) {
      if (enough()) return;
      for (const Touch& touch : t.touches) t.is_cut = t.is_cut || cuts(touch);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint8_t where = location_of_vertex(t.triangle, corner);
        bits_ |= where;
        t.is_done = t.is_done || (!t.is_cut && where != 0);
      }
    }
  }

  /// Cuts the remaining triangles to pieces and locates a point of each.
  template <class Enough>
  void locate_pieces(const Enough& enough) {
    for (const Touched& t : touched_) {
      if (enough() || is_complete()) return;
      if (!t.is_done) locate_pieces_of(t);
    }
  }

  [[nodiscard]] std::uint8_t bits() const { return bits_; }

 private:
  struct Touched {
    std::uint32_t triangle;
    std::span<const Touch> touches;
    bool is_cut = false, is_done = false;
  };
  static constexpr std::uint8_t kUnknown = 0xff;

  /// Whether no other bit can be found.
  [[nodiscard]] bool is_complete() const { return (bits_ & kOutside) != 0 && (bits_ & kInside) != 0; }

  /// Whether the other triangle reaches into the interior of the own one.
  [[nodiscard]] bool cuts(const Touch& touch) const {
    if (touch.kind != Kind::touching) return touch.kind == Kind::crossing || touch.shares_area;
    return reaches_inside(other_.body.triangle(touch.other), own_.body.triangle(touch.own));
  }

  /// Where a point lies: kInside, kOutside, or 0 on the other boundary.
  template <class Point>
  [[nodiscard]] std::uint8_t location_of(const Point& point) const {
    const Around found = around(other_.body.placed, point);
    const auto is_boundary = [&](std::uint32_t t) { return other_.is_boundary(t); };
    if (std::any_of(found.holders.begin(), found.holders.end(), is_boundary)) return 0;
    return found.beside != 0 ? kInside : kOutside;
  }

  /// Where a corner of a triangle lies.
  std::uint8_t location_of_vertex(std::uint32_t t, std::size_t corner) {
    std::uint8_t& known = of_group_[groups_.find(own_.corners(t)[corner])];
    if (known == kUnknown) known = location_of(own_.body.triangle(t)[corner]);
    return known;
  }

  void locate_pieces_of(const Touched& t) {
    const Triangle triangle = own_.body.triangle(t.triangle);
    std::vector<Triangle> shared, cutting;
    for (const Touch& touch : t.touches) {
      if (!t.is_cut) break;
      const Triangle other = other_.body.triangle(touch.other);
      if (!cuts(touch)) continue;
      if (touch.shares_area && covers(other, triangle)) return;
      (touch.shares_area ? shared : cutting).push_back(other);
    }
    const CutTriangle cut(triangle, shared, cutting);
    for (std::size_t i = 0; i < cut.pieces() && !is_complete(); ++i) {
      const std::uint8_t where = location_of(cut.point_in(i));
      assert(where != 0);  // no piece meets the other boundary
      bits_ |= where;
    }
  }

  const Part &own_, &other_;
  std::vector<Touch> touches_;    ///< sorted by triangle
  std::vector<Touched> touched_;  ///< by triangle
  DisjointSets groups_;           ///< connected patches of positions
  std::vector<std::uint8_t> of_group_;
  std::uint8_t bits_ = 0;
};

}  // namespace

// The cheap steps come first: shared areas, patches, vertices, and then pieces. A crossing pair alone does not prove
// that a cell is inside: another triangle of the same solid may have an edge along the line of the crossing, with the
// outside on both sides.
Cells cells_of(const Part& a, const Part& b, std::span<const exact::Contact> contacts, const Enough& enough) {
  std::vector<Touch> touches = touches_of(a, b, contacts);
  std::uint8_t shared = 0;
  for (const Touch& touch : touches)
    if (touch.shares_area) shared |= shared_cell(a, b, touch);
  Located in_b(a, b, touches), in_a(b, a, turned(std::move(touches)));
  const auto cells = [&]() -> Cells {
    return {static_cast<std::uint8_t>(in_b.bits() | shared), static_cast<std::uint8_t>(in_a.bits() | shared)};
  };
  const auto is_enough = [&] { return enough(cells()); };
  for (Located* const located : {&in_b, &in_a}) located->locate_patches(is_enough);
  for (Located* const located : {&in_b, &in_a}) located->locate_vertices(is_enough);
  for (Located* const located : {&in_b, &in_a}) located->locate_pieces(is_enough);
  return cells();
}

}  // namespace impinge::solid
