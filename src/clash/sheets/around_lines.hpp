// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "broad/box_tree.hpp"
#include "clash/sheets/half_planes.hpp"
#include "clash/sheets/sheets.hpp"
#include "core/disjoint_sets.hpp"
#include "core/shapes.hpp"

/// Decides whether two surfaces cross by the half-planes around their common lines. The caller knows the geometry of
/// the triangles, exactly or within a tolerance, and lists the half-planes around each piece of such a line in order.
namespace impinge::clash {

/// The triangles of one part that meet triangles of the other part.
struct MetSide {
  const solid::Part& part;
  Sheets sheets;
  std::vector<std::vector<std::uint32_t>>
      met;  ///< per index of a triangle, the indices of the other part's triangles that it meets

  [[nodiscard]] Triangle triangle(std::uint32_t index) const { return part.body.triangle(sheets.ids[index]); }
};

/// Both parts' sides of some pairs of triangles, exactly or within a tolerance. Sheets are made of these, and of others
/// that are named besides.
template <class Pairs>
std::array<MetSide, 2> sides_of(const solid::Part& a, const solid::Part& b, const Pairs& pairs, double tolerance,
                                std::vector<std::uint32_t> ids_a = {}, std::vector<std::uint32_t> ids_b = {}) {
  for (const auto& pair : pairs) ids_a.push_back(pair.a), ids_b.push_back(pair.b);
  std::array<MetSide, 2> sides{MetSide{a, sheets_of(a, std::move(ids_a), tolerance), {}},
                               MetSide{b, sheets_of(b, std::move(ids_b), tolerance), {}}};
  for (MetSide& side : sides) side.met.resize(side.sheets.ids.size());
  for (const auto& pair : pairs) {
    if (!a.is_boundary(pair.a) || !b.is_boundary(pair.b)) continue;
    const std::uint32_t i = sides[0].sheets.index(pair.a), j = sides[1].sheets.index(pair.b);
    sides[0].met[i].push_back(j), sides[1].met[j].push_back(i);
  }
  return sides;
}

/// Finds a side's triangles along an edge.
class AlongEdge {
 public:
  AlongEdge(const MetSide& side, const MetSide& other);

  /// Those whose boxes overlap this one and that some of these, of the other side, meet. Sorted.
  std::vector<std::uint32_t> find(const Box& box, const std::vector<std::uint32_t>& others);

 private:
  [[nodiscard]] std::vector<std::uint32_t> find_all(const Box& box);

  const MetSide &side_, &other_;
  std::vector<Box> boxes_;
  std::optional<broad::BoxTree> tree_;  ///< over them, once it is needed
  broad::BoxTree::Search search_;
  std::vector<bool> is_asked_;  ///< of the other side's; none but while they are looked for
};

/// An edge of some of a side's triangles: each use is three times a triangle's index, and which of its edges.
using Uses = std::vector<std::uint32_t>;
/// The triangles, once each.
std::vector<std::uint32_t> triangles_of(const Uses& uses);
std::vector<Uses> edges_of(const MetSide& side);

/// Flaps are numbered by twice their triangle's index, and 1 for those of b.
inline bool is_of_a(const HalfPlane& half_plane) { return half_plane.triangle % 2 == 0; }

/// Flaps in one half-plane.
using Ray = std::vector<HalfPlane>;

class AroundLines {
 public:
  AroundLines(const Sheets& a, const Sheets& b) : a_(a), b_(b), areas_(a.ids.size()) {}

  /// Two triangles of a lie over a common one of b: they are in one area. (The areas may be apart; then the sheet is
  /// there in both.)
  void join(std::uint32_t i, std::uint32_t j) { areas_.join(i, j); }
  /// All those that do, by whether two triangles that meet `share` an area.
  template <class ShareArea>
  void join_areas(const MetSide& b, const ShareArea& share) {
    for (std::uint32_t j = 0; j < b.met.size(); ++j) {
      std::optional<std::uint32_t> first;
      for (const std::uint32_t i : b.met[j]) {
        if (!share(i, j)) continue;
        if (first) join(*first, i);
        first = i;
      }
    }
  }

  /// Whether the surfaces pass through each other at a piece of a line, of the rays around it. Where they have
  /// half-planes in common, it is noted what the others are to their area.
  bool look_around(const std::vector<Ray>& rays);

  /// Whether they do around some area, once all lines were looked at.
  bool pass_at_areas();

 private:
  /// That a half-plane in one part alone is beside one of the other, where a common area ends.
  struct Seen {
    std::uint32_t area;  ///< a triangle of a that is of it
    HalfPlane own, from;
    bool is_a;  ///< the part that `own` is of
    std::uint8_t sides;
  };

  [[nodiscard]] std::uint32_t cluster_of(const HalfPlane& half_plane) const;
  [[nodiscard]] bool alternate(const std::vector<Ray>& rays) const;
  [[nodiscard]] bool alternate(const std::vector<Ray>& rays, std::uint32_t cluster_a, std::uint32_t cluster_b) const;
  void note_sides(const std::vector<Ray>& rays, std::size_t at, std::uint32_t area);

  const Sheets &a_, &b_;
  DisjointSets areas_;
  std::vector<Seen> seen_;
};

}  // namespace impinge::clash
