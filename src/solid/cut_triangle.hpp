// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "exact/rational.hpp"

namespace impinge::solid {

/// A proper triangle cut into convex pieces by others that meet it, exactly. Pieces are bounded by lines in the
/// triangle's plane, projected along an axis, and corners are where two of those lines meet: however often pieces are
/// cut, numbers grow no longer than that makes them. All are integers on a grid that holds the vertices of all
/// triangles, about one of the triangle's own.
class CutTriangle {
 public:
  /// `others`: those that are to come.
  CutTriangle(const Triangle& triangle, std::span<const Triangle> others);

  /// Removes what a proper triangle of the same plane covers.
  void take_out(const Triangle& coplanar);
  /// Cuts along the plane of a proper triangle that is not parallel, where that triangle meets a piece's interior, be
  /// it in a point: afterwards no piece's interior meets it.
  void split(const Triangle& other);

  [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }
  /// A point of a piece's interior.
  [[nodiscard]] exact::RationalPoint point_in(std::size_t piece) const;

 private:
  using Int = boost::multiprecision::cpp_int;
  using IntPoint = std::array<Int, 3>;

  /// a u + b v + c = 0, exactly and rounded: relatively within 2^-51 each, but for one factor, a power of two.
  struct Line {
    Int a, b, c;
    std::array<double, 3> rounded;
  };
  /// (u, v) / w, w > 0; `rounded` is relatively within 2^-50.
  struct Corner {
    Int u, v, w;
    std::array<double, 2> rounded;
  };
  struct Edge {
    const Line* line;
    int side;  ///< of the line: where the piece is
    Corner from;
  };
  using Piece = std::vector<Edge>;

  [[nodiscard]] IntPoint on_grid(const Vec3& p) const;
  [[nodiscard]] Corner corner(Int u, Int v, Int w) const;
  [[nodiscard]] Corner corner(const IntPoint& p) const;
  [[nodiscard]] Corner meeting(const Line& p, const Line& q) const;
  const Line* line(Int a, Int b, Int c);
  const Line* line(const IntPoint& from, const IntPoint& to);
  static int side(const Line& line, const Corner& corner);

  /// The part of a piece on one side of a line that passes through its interior; `sides` are those of its corners.
  [[nodiscard]] Piece part_of(const Piece& piece, const Line& line, int side, const std::vector<int>& sides) const;
  /// The sides of a piece's corners of a line; empty where the line does not pass through its interior.
  static std::vector<int> sides_if_cut(const Piece& piece, const Line& line);
  [[nodiscard]] exact::RationalPoint in_space(const Corner& p) const;
  static bool holds(const Piece& piece, const Corner& p);

  Vec3 origin_;
  int unit_ = 0;               ///< the grid's: 2 to this power
  int u_ = 0, v_ = 1, w_ = 2;  ///< axes: the last is left out
  IntPoint normal_;
  std::deque<Line> lines_;  ///< which pieces refer to
  std::vector<Piece> pieces_;
};

}  // namespace impinge::solid
