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
#include "solid/degenerate_cells.hpp"
#include "solid/locate.hpp"
#include "solid/triangles.hpp"

namespace impinge::solid {
namespace {

/// A pair of boundary triangles that share a point, as one of the two sees it.
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

/// What two triangles that share an area have of both boundaries. A side is +1 if it is the one the normal points to.
Where shared_cell(const Part& a, const Part& b, const Touch& touch) {
  if (!a.solid || !b.solid) return kSameSide;
  const int side_a = a.sides[a.topology.shell[touch.own]].front ? 1 : -1;
  const int side_b = b.sides[b.topology.shell[touch.other]].front ? 1 : -1;
  const bool turned = !same_orientation(a.body.triangle(touch.own), b.body.triangle(touch.other));
  return (side_a == side_b) != turned ? kSameSide : kOtherSide;
}

/// The cells of one part's boundary that lie inside or outside of the other part. What the two share is known already.
///
/// Only boundary triangles of either count. Another sheet of the other part has the inside, or the outside, on both its
/// sides: points in it are located by what is beside them.
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

  /// What untouched triangles say. They share no point with the other's boundary, and neither does a patch of them that
  /// hangs together: one of its vertices says where all of it lies.
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

  /// What the vertices of touched triangles say: beside one that is off the other's boundary, the cells of its
  /// triangles lie where it does. Triangles that have such a vertex, and that nothing cuts, are done.
  template <class Enough>
  void locate_vertices(const Enough& enough) {
    for (Touched& t : touched_) {
      if (enough()) return;
      for (const Touch& touch : t.touches) t.is_cut = t.is_cut || cuts(touch);
      if (!other_.solid) {
        t.is_done = !t.is_cut;
        if (t.is_done) bits_ |= kOutside;
        continue;
      }
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint8_t where = location_of_vertex(t.triangle, corner);
        bits_ |= where;
        t.is_done = t.is_done || (!t.is_cut && where != 0);
      }
    }
  }

  /// What is left: cut to pieces, of each of which a point says where it lies.
  template <class Enough>
  void locate_pieces(const Enough& enough, bool of_shared = true) {
    const auto shares = [](const Touch& touch) { return touch.shares_area; };
    for (const Touched& t : touched_) {
      if (enough() || is_complete()) return;
      if (!t.is_done && (of_shared || std::none_of(t.touches.begin(), t.touches.end(), shares))) locate_pieces_of(t);
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

  /// Whether nothing is left to be found.
  [[nodiscard]] bool is_complete() const {
    return (bits_ & kOutside) != 0 && ((bits_ & kInside) != 0 || !other_.solid);
  }

  /// Whether the other triangle reaches into the interior of the own one.
  [[nodiscard]] bool cuts(const Touch& touch) const {
    if (touch.kind != Kind::touching) return touch.kind == Kind::crossing || touch.shares_area;
    return reaches_inside(other_.body.triangle(touch.other), own_.body.triangle(touch.own));
  }

  /// kInside or kOutside; 0 on the other's boundary.
  template <class Point>
  [[nodiscard]] std::uint8_t location_of(const Point& point) const {
    const Around found = around(other_.body.placed, point);
    const auto is_boundary = [&](std::uint32_t t) { return other_.is_boundary(t); };
    if (std::any_of(found.holders.begin(), found.holders.end(), is_boundary)) return 0;
    return found.beside != 0 ? kInside : kOutside;
  }

  /// Of a vertex of an untouched triangle, or of one of a touched one with a solid.
  std::uint8_t location_of_vertex(std::uint32_t t, std::size_t corner) {
    if (!other_.solid) return kOutside;
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
      if (touch.shares_area)
        shared.push_back(other);
      else if (other_.solid)
        cutting.push_back(other);  // outside of what is not solid all pieces lie alike
    }
    const CutTriangle cut(triangle, shared, cutting);
    if (!other_.solid) {
      if (cut.pieces() > 0) bits_ |= kOutside;
      return;
    }
    for (std::size_t i = 0; i < cut.pieces() && !is_complete(); ++i) {
      const std::uint8_t where = location_of(cut.point_in(i));
      assert(where != 0);  // or a piece still meets the other's boundary
      bits_ |= where;
    }
  }

  const Part &own_, &other_;
  std::vector<Touch> touches_;    ///< by triangle
  std::vector<Touched> touched_;  ///< by triangle
  DisjointSets groups_;           ///< positions in one patch
  std::vector<std::uint8_t> of_group_;
  std::uint8_t bits_ = 0;
};

/// The cells of a surface's triangles without an area: the segments and points that they are.
template <class Enough>
std::uint8_t locate_degenerate(const Part& own, const Part& other, std::span<const exact::Contact> contacts,
                               bool own_is_first, const Enough& enough) {
  std::uint8_t bits = 0;
  if (own.solid || own.topology.degenerate == 0) return bits;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const exact::Contact& contact : contacts)
    pairs.push_back(own_is_first ? std::pair(contact.a, contact.b) : std::pair(contact.b, contact.a));
  std::sort(pairs.begin(), pairs.end());
  auto next = pairs.begin();
  std::vector<std::uint32_t> touching;
  for (std::uint32_t t = 0; t < own.body.size() && !enough(bits); ++t) {
    touching.clear();
    for (; next != pairs.end() && next->first == t; ++next) touching.push_back(next->second);
    if (own.topology.shell[t] == Topology::kNoShell) bits |= cells_of_degenerate(own.body.triangle(t), other, touching);
  }
  return bits;
}

}  // namespace

// What is cheap comes first: shared areas, patches, vertices, and then pieces. A crossing pair is no proof by itself:
// along the line in which it crosses, another triangle of the same solid may stand with its edge, and turn what is
// inside to the outside; a vertex nearby mostly is.
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
  Cells all = cells();
  all.a |= locate_degenerate(a, b, contacts, true, [&](std::uint8_t bits) {
    return enough({static_cast<std::uint8_t>(all.a | bits), all.b});
  });
  all.b |= locate_degenerate(b, a, contacts, false, [&](std::uint8_t bits) {
    return enough({all.a, static_cast<std::uint8_t>(all.b | bits)});
  });
  return all;
}

bool reach_into_each_other(const Part& a, const Part& b, std::span<const exact::Contact> contacts) {
  std::vector<Touch> touches = touches_of(a, b, contacts);
  Located in_b(a, b, touches), in_a(b, a, turned(std::move(touches)));
  const auto is_inside = [&] { return ((in_b.bits() | in_a.bits()) & kInside) != 0; };
  for (Located* const located : {&in_b, &in_a}) located->locate_patches(is_inside);
  for (Located* const located : {&in_b, &in_a}) located->locate_vertices(is_inside);
  for (Located* const located : {&in_b, &in_a}) located->locate_pieces(is_inside, false);
  return is_inside();
}

}  // namespace impinge::solid
