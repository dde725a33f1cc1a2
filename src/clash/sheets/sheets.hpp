// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "solid/part.hpp"

namespace impinge::clash {

/// The sides of a sheet, as or-ed bits.
inline constexpr std::uint8_t kAbove = 1, kBelow = 2;

inline std::uint8_t turned(std::uint8_t sides, int way) {
  if (way > 0) return sides;
  return static_cast<std::uint8_t>(((sides & kAbove) != 0 ? kBelow : 0) | ((sides & kBelow) != 0 ? kAbove : 0));
}

/// The edge from a triangle's corner to the next.
struct TriangleEdge {
  std::uint32_t triangle;  ///< its id
  std::uint32_t corner;
};

/// Some proper triangles of a part, and how they are connected.
struct Sheets {
  std::vector<std::uint32_t> ids;      ///< sorted
  std::vector<std::uint32_t> cluster;  ///< connected by common vertices, and by vertices on edges
  std::vector<std::uint32_t>
      piece;              ///< connected by pieces of edges that exactly two use; coincident triangles count as one
  std::vector<int> side;  ///< +1 or -1: times these, the normals of one piece are oriented alike

  /// Another piece at an edge of three or more triangles: any two such pieces make one sheet, after one is turned.
  struct Link {
    std::uint32_t piece;
    int turn;
  };
  std::vector<std::vector<Link>> links;  ///< per piece

  /// A piece of an edge from which all of these triangles go the same way.
  struct End {
    Segment piece;
    std::array<std::uint32_t, 2> positions;
    TriangleEdge of;  ///< of one of them
  };
  std::vector<End> ends;

  [[nodiscard]] std::uint32_t index(std::uint32_t id) const {
    return static_cast<std::uint32_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
  }
};

/// Whether two triangles with edges along one line go the same way from it: if they are of one surface, it is folded
/// flat.
bool go_one_way(const solid::Part& part, const TriangleEdge& p, const TriangleEdge& q);

/// Degenerate ones, and those that are named twice, are left out. Within a tolerance of an edge a vertex is on it.
Sheets sheets_of(const solid::Part& part, std::vector<std::uint32_t> ids, double tolerance);

/// Collects, for each piece of some sheets, the sides on which the other part was seen.
class SidesSeen {
 public:
  /// Adds what is seen from a triangle, by its index.
  void add(const Sheets& sheets, std::uint32_t triangle, std::uint8_t sides);
  /// The same of what lies on the pieces `on`, which are joined to the triangle's: it is on a side of the sheets that
  /// this one makes with others.
  void add_between(const Sheets& sheets, std::uint32_t triangle, std::uint8_t sides,
                   const std::vector<std::uint32_t>& on);
  [[nodiscard]] std::uint8_t from(const Sheets& sheets, std::uint32_t triangle) const;
  /// Whether something is on both sides of some sheet.
  [[nodiscard]] bool has_both() const { return has_both_; }

 private:
  using Pieces = std::array<std::uint32_t, 2>;
  void look_at(std::uint32_t piece, const Sheets::Link& link);

  std::map<std::uint32_t, std::uint8_t> of_piece_;
  std::map<Pieces, std::uint8_t> of_two_;  ///< as the first of them looks
  bool has_both_ = false;
};

}  // namespace impinge::clash
