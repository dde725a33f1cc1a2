// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "clash/kd_tree.hpp"
#include "clash/regions/lines.hpp"

namespace impinge::clash {

/// Splits pieces at the points no farther than `within` from them, so that pieces that overlap become equal where they
/// do. Computes in a unit near the size of the whole, about an origin in its middle. Pieces are left as they are where
/// there would be very many more of them.
class Splitter {
 public:
  struct Setting {
    Vec3 origin;
    double unit;    ///< a power of two
    double within;  ///< in units
    std::stop_token stop{};
  };
  /// The points may be in any order and repeated.
  Splitter(std::vector<Vec3> points, const Setting& setting);
  [[nodiscard]] std::vector<Piece> split(const std::vector<Piece>& pieces) const;

  /// The same where points may be as near to each other as to a piece. A point beside a piece makes a detour of it, and
  /// of three such points each is beside the piece between the others: only points count whose parts are both shorter
  /// than the piece. Splits repeatedly, since parts may come near points from which the piece was farther; `tidy`
  /// reduces the number of pieces after each round.
  using Tidy = std::vector<Piece> (*)(std::vector<Piece>, const std::stop_token&);
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
  [[nodiscard]] std::vector<Vec3> sorted(std::vector<Vec3> points) const;
  [[nodiscard]] std::vector<Vec3> local(const std::vector<Vec3>& points) const;
  [[nodiscard]] std::vector<Found> points_beside(const Segment& edge) const;

  Setting setting_;
  std::vector<Vec3> points_;  ///< in the world
  KdTree tree_;               ///< over them, in local coordinates
};

}  // namespace impinge::clash
