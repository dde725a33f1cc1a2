// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "clash/sheets/around_lines.hpp"
#include "clash/sheets/flat_line.hpp"
#include "clash/sheets/sections.hpp"
#include "clash/sheets/surface_crossing.hpp"
#include "core/shapes.hpp"
#include "exact/triangle_pair.hpp"

/// Where no two triangles cross, surfaces cross only along an edge of one of them: along each piece of the edge both
/// have half-planes around one line. Half-planes in both surfaces belong to a common area, which a sheet may leave on
/// one side here and on the other elsewhere.
namespace impinge::clash {
namespace {

class ExactCrossing {
 public:
  ExactCrossing(const std::array<MetSide, 2>& sides, const std::array<std::vector<bool>, 2>& flat)
      : a_(sides[0]),
        b_(sides[1]),
        flat_a_(flat[0]),
        flat_b_(flat[1]),
        around_(a_.sheets, b_.sheets),
        along_a_(a_, b_),
        along_b_(b_, a_) {}

  bool find() {
    if (look_along_edges(a_, true) || look_along_edges(b_, false)) return true;
    around_.join_areas(
        b_, [&](std::uint32_t i, std::uint32_t j) { return exact::share_area(a_.triangle(i), b_.triangle(j)); });
    return around_.pass_at_areas();
  }

 private:
  /// Whether somewhere along an edge of one part's the surfaces pass through each other.
  bool look_along_edges(const MetSide& side, bool is_a) {
    const std::vector<Uses> edges = edges_of(side);
    return std::any_of(edges.begin(), edges.end(), [&](const Uses& uses) {
      const Triangle first = side.triangle(uses[0] / 3);
      return look_along(Line(first[uses[0] % 3], first[(uses[0] % 3 + 1) % 3]), uses, is_a);
    });
  }

  bool look_along(const Line& line, const std::vector<std::uint32_t>& uses, bool is_a) {
    const Box box{min(line.from(), line.to()), max(line.from(), line.to())};
    AlongEdge &along_own = is_a ? along_a_ : along_b_, &along_other = is_a ? along_b_ : along_a_;
    const std::vector<std::uint32_t> other = along_other.find(box, triangles_of(uses));
    if (is_flat(uses, other, is_a)) return join_across(line, other, is_a), false;
    std::vector<Stretch> stretches = stretches_of(line, other, !is_a);
    if (stretches.empty()) return false;
    std::vector<std::uint32_t> there;
    there.reserve(stretches.size());
    for (const Stretch& stretch : stretches) there.push_back(stretch.half_planes[0].triangle >> 1);
    for (Stretch& stretch : stretches_of(line, along_own.find(box, there), is_a))
      stretches.push_back(std::move(stretch));
    bool crosses = false;
    each_section(std::move(stretches), [&](const std::vector<const Stretch*>& open, const auto&, const auto&) {
      std::vector<HalfPlane> half_planes;
      for (const Stretch* const stretch : open)
        half_planes.insert(half_planes.end(), stretch->half_planes.begin(), stretch->half_planes.end());
      crosses = half_planes.size() >= 4 && around_.look_around(in_order(line, half_planes));
      return !crosses;
    });
    return crosses;
  }

  /// Whether all that may have half-planes over a common piece of an edge, of which these are the uses, is in one
  /// plane.
  [[nodiscard]] bool is_flat(const Uses& uses, const std::vector<std::uint32_t>& other, bool is_a) const {
    const std::vector<bool>&own_flat = is_a ? flat_a_ : flat_b_, &other_flat = is_a ? flat_b_ : flat_a_;
    return std::all_of(uses.begin(), uses.end(), [&](std::uint32_t use) { return own_flat[use / 3]; }) &&
           std::all_of(other.begin(), other.end(), [&](std::uint32_t t) { return other_flat[t]; });
  }

  /// In one plane there are two half-planes around a line, so that nothing passes and nothing is on one side of the
  /// other: what is left of `look_around` is that areas are joined. What is in one half-plane is in one area already,
  /// and so is all that a triangle on both sides of the line shares an area with. Areas are joined anew where all end.
  void join_across(const Line& line, const std::vector<std::uint32_t>& other, bool is_a) {
    std::vector<EdgeOnLine> edges;
    const auto list = [&](const std::vector<std::uint32_t>& triangles, bool of_a) {
      for (const std::uint32_t t : triangles)
        if (const auto edge = edge_on_line(line, (of_a ? a_ : b_).triangle(t), t, of_a)) edges.push_back(*edge);
    };
    list(other, !is_a);
    const Box box{min(line.from(), line.to()), max(line.from(), line.to())};
    std::vector<std::uint32_t> there;
    there.reserve(edges.size());
    for (const EdgeOnLine& edge : edges) there.push_back(edge.triangle);
    list((is_a ? along_a_ : along_b_).find(box, there), is_a);
    for (const std::vector<std::uint32_t>& of_a : where_all_meet(edges))
      for (const std::uint32_t t : of_a) around_.join(of_a[0], t);
  }

  /// What triangles have of the line between its points. Numbers are twice a triangle's index, and 1 for those of b.
  std::vector<Stretch> stretches_of(const Line& line, const std::vector<std::uint32_t>& triangles, bool of_a) const {
    const exact::Rational from = line.along(line.from()), to = line.along(line.to());
    std::vector<Stretch> stretches;
    for (const std::uint32_t t : triangles) {
      auto stretch = stretch_of(line, of_a ? a_.triangle(t) : b_.triangle(t), 2 * t + (of_a ? 0 : 1));
      if (!stretch) continue;
      stretch->lo = std::max(stretch->lo, from), stretch->hi = std::min(stretch->hi, to);
      if (stretch->lo < stretch->hi) stretches.push_back(*std::move(stretch));
    }
    return stretches;
  }

  const MetSide &a_, &b_;
  const std::vector<bool>&flat_a_, &flat_b_;  ///< per triangle: whether all that it meets lies in its plane
  AroundLines around_;
  AlongEdge along_a_, along_b_;
};

}  // namespace

bool surfaces_cross_exactly(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts) {
  if (std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.kind == Kind::crossing; }))
    return true;
  const std::array<MetSide, 2> sides = sides_of(a, b, contacts, 0);
  std::array<std::vector<bool>, 2> flat;
  for (std::size_t i = 0; i < 2; ++i) flat[i].resize(sides[i].sheets.ids.size(), true);
  for (const exact::Contact& contact : contacts)
    if (contact.kind != Kind::coplanar && a.is_boundary(contact.a) && b.is_boundary(contact.b))
      flat[0][sides[0].sheets.index(contact.a)] = flat[1][sides[1].sheets.index(contact.b)] = false;
  return ExactCrossing(sides, flat).find();
}

}  // namespace impinge::clash
