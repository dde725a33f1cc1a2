// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "clash/lines.hpp"

namespace impinge::clash {

/// Pieces with each divided at those of the points that are no farther than `within` from it, so that pieces which lie
/// over each other become equal where they do; parts are shorter than what they are parts of. Lengths are taken in a
/// unit near the whole's size, and from an origin in its middle. Where there would be very many more pieces than there
/// were, they stay as they are.
class Splitter {
 public:
  struct Setting {
    Vec3 origin;
    double unit;    ///< of the caller's, a power of two
    double within;  ///< in this unit
  };
  /// The points, in any order and as often as one likes.
  Splitter(std::vector<Vec3> points, const Setting& setting);
  /// At most so often, for a piece's parts may come near points from which the whole was farther. In between `tidy`
  /// keeps their number down.
  using Tidy = std::vector<Piece> (*)(std::vector<Piece>);
  [[nodiscard]] std::vector<Piece> split(std::vector<Piece> pieces, int rounds = 1, Tidy tidy = merged) const;

 private:
  struct Point {
    Vec3 local, world;
  };
  struct Found {
    double along;
    Vec3 point;
  };
  [[nodiscard]] Vec3 local(const Vec3& p) const { return (1 / setting_.unit) * (p - setting_.origin); }
  [[nodiscard]] std::vector<Piece> split_once(std::vector<Piece> pieces, std::size_t most) const;
  void build(std::size_t begin, std::size_t end, int axis);
  void look_at(const Segment& edge, const Point& point, std::vector<Found>& found) const;
  void search(const Segment& edge, const Segment& rest, std::size_t begin, std::size_t end, int axis,
              std::vector<Found>& found) const;

  Setting setting_;
  std::vector<Point> points_;  ///< a k-d tree: the middle of each range parts the rest
};

}  // namespace impinge::clash
