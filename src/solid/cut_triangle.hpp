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
  /// All are proper. Of `shared`, which lie in the triangle's plane, what they cover is taken out. Of `cutting`, whose
  /// planes are not parallel to it, none meets the interior of a piece, not in a point either.
  CutTriangle(const Triangle& triangle, std::span<const Triangle> shared, std::span<const Triangle> cutting);

  [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }
  /// In order along its boundary.
  [[nodiscard]] std::vector<exact::RationalPoint> corners(std::size_t piece) const;
  /// A point of a piece's interior.
  [[nodiscard]] exact::RationalPoint point_in(std::size_t piece) const;

 private:
  using Int = exact::Integer;
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
  using Lines = std::vector<const Line*>;

  /// Certainly around what is rounded.
  struct Bounds {
    std::array<double, 2> lo, hi;
  };
  static constexpr Bounds kNowhere{{1e300, 1e300}, {-1e300, -1e300}};
  static bool overlap(const Bounds& a, const Bounds& b) {
    return a.lo[0] <= b.hi[0] && b.lo[0] <= a.hi[0] && a.lo[1] <= b.hi[1] && b.lo[1] <= a.hi[1];
  }

  /// What another triangle has of the plane.
  struct Trace {
    std::vector<Corner> corners;  ///< its own, or the ends of its chord
    Lines lines;                  ///< along its edges, or along its chord
    int inner;                    ///< the side of the edges on which it lies; 0 of a chord
    Bounds bounds;
  };

  [[nodiscard]] IntPoint on_grid(const Vec3& p) const;
  static Corner corner(Int u, Int v, Int w);
  [[nodiscard]] Corner corner(const IntPoint& p) const;
  static Corner meeting(const Line& p, const Line& q);
  const Line* line(Int a, Int b, Int c);
  const Line* line(const IntPoint& from, const IntPoint& to);
  static int side(const Line& line, const Corner& corner);
  static Bounds grown(Bounds bounds, const Corner& corner);
  static Bounds bounds_of(const Piece& piece);

  Trace trace_of_coplanar(const Triangle& triangle);
  Trace trace_of_crossing(const Triangle& triangle);
  void divide(Piece piece, const std::vector<const Trace*>& traces, int depth);
  const Line* line_between(const std::vector<const Trace*>& traces, std::size_t axis);

  static bool meets_inside(const Piece& piece, const Trace& trace);
  void take_out(const Trace& trace, std::vector<Piece>& pieces) const;
  void split(const Trace& trace, std::vector<Piece>& pieces) const;
  /// The sides of a piece's corners of a line; empty where the line does not pass through its interior.
  static std::vector<int> sides_if_cut(const Piece& piece, const Line& line);
  /// The part of a piece on one side of a line that passes through its interior; `sides` are those of its corners.
  static Piece part_of(const Piece& piece, const Line& line, int side, const std::vector<int>& sides);
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
