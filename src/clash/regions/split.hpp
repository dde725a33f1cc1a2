// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "clash/kd_tree.hpp"
#include "clash/regions/lines.hpp"

namespace impinge::clash {

/// Pieces with each divided at those of the points that are no farther than `within` from it, so that pieces which lie
/// over each other become equal where they do. Lengths are taken in a unit near the whole's size, and from an origin in
/// its middle. Where there would be very many more pieces than there were, they stay as they are.
class Splitter {
 public:
  struct Setting {
    Vec3 origin;
    double unit;    ///< of the caller's, a power of two
    double within;  ///< in this unit
  };
  /// The points, in any order and as often as one likes.
  Splitter(std::vector<Vec3> points, const Setting& setting);
  [[nodiscard]] std::vector<Piece> split(const std::vector<Piece>& pieces) const;

  /// Where points may be as near to each other as to a piece. One that lies beside a piece would make a detour of it,
  /// and of three such points each is beside the others' piece: only those count that leave parts shorter than what
  /// they part. This is done again and again, for parts may come near points from which the whole was farther; in
  /// between `tidy` keeps their number down.
  using Tidy = std::vector<Piece> (*)(std::vector<Piece>);
  [[nodiscard]] std::vector<Piece> split_closely(std::vector<Piece> pieces, Tidy tidy) const;

 private:
  struct Point {
    Vec3 local, world;
  };
  struct Found {
    double along, off;
    Point point;
  };
  [[nodiscard]] Vec3 local(const Vec3& p) const { return (1 / setting_.unit) * (p - setting_.origin); }
  [[nodiscard]] std::size_t budget(const std::vector<Piece>& pieces) const;
  [[nodiscard]] std::vector<Piece> split(const std::vector<Piece>& pieces, std::size_t most, bool closely) const;
  static void keep_what_shortens(const Segment& edge, std::vector<Found>& found);
  static std::vector<Vec3> sorted(std::vector<Vec3> points);
  [[nodiscard]] std::vector<Vec3> local(const std::vector<Vec3>& points) const;
  [[nodiscard]] std::vector<Found> points_beside(const Segment& edge) const;

  Setting setting_;
  std::vector<Vec3> points_;  ///< in the world
  KdTree tree_;               ///< over them, in local coordinates
};

}  // namespace impinge::clash
