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

/// Cuts a proper triangle exactly into convex pieces by the triangles that meet it. Pieces are bounded by lines in the
/// triangle's plane, projected along an axis, and their corners are where two of these lines meet: however often pieces
/// are cut, numbers grow no longer than that. All numbers are integers on a grid that holds the vertices of all
/// triangles, with one vertex of the triangle as its origin.
class CutTriangle {
 public:
  /// All triangles are proper. Those in `shared` lie in the triangle's plane: the areas that they cover are removed.
  /// Those in `cutting` have other planes: no point of them lies in the interior of a piece.
  CutTriangle(const Triangle& triangle, std::span<const Triangle> shared, std::span<const Triangle> cutting);

  [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }
  /// The corners of a piece, in order along its boundary.
  [[nodiscard]] std::vector<exact::RationalPoint> corners(std::size_t piece) const;
  /// A point in the interior of a piece.
  [[nodiscard]] exact::RationalPoint point_in(std::size_t piece) const;

 private:
  using Int = exact::Integer;
  using IntPoint = std::array<Int, 3>;

  /// The line a u + b v + c = 0, exact and rounded: `rounded` is relatively within 2^-51 of (a, b, c) times a power of
  /// two.
  struct Line {
    Int a, b, c;
    std::array<double, 3> rounded;
  };
  /// The point (u, v) / w with w > 0; `rounded` is relatively within 2^-50 of it.
  struct Corner {
    Int u, v, w;
    std::array<double, 2> rounded;
  };
  struct Edge {
    const Line* line;
    int side;  ///< the side of the line on which the piece lies
    Corner from;
  };
  using Piece = std::vector<Edge>;
  using Lines = std::vector<const Line*>;

  /// A box that certainly holds the exact points.
  struct Bounds {
    std::array<double, 2> lo, hi;
  };
  static constexpr Bounds kNowhere{{1e300, 1e300}, {-1e300, -1e300}};
  static bool overlap(const Bounds& a, const Bounds& b) {
    return a.lo[0] <= b.hi[0] && b.lo[0] <= a.hi[0] && a.lo[1] <= b.hi[1] && b.lo[1] <= a.hi[1];
  }

  /// The intersection of another triangle with the plane.
  struct Trace {
    std::vector<Corner> corners;  ///< the corners of a coplanar triangle, or the ends of a chord
    Lines lines;                  ///< along its edges, or along its chord
    int inner;                    ///< the side of the edges on which the triangle lies; 0 for a chord
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
  /// On which sides of a line a piece's corners lie; empty if the line does not pass through its interior.
  static std::vector<int> sides_if_cut(const Piece& piece, const Line& line);
  /// The part of a piece on one side of a line through its interior; `sides` are those of its corners.
  static Piece part_of(const Piece& piece, const Line& line, int side, const std::vector<int>& sides);
  [[nodiscard]] exact::RationalPoint in_space(const Corner& p) const;
  static bool holds(const Piece& piece, const Corner& p);

  Vec3 origin_;
  int unit_ = 0;               ///< the grid's spacing is 2 to this power
  int u_ = 0, v_ = 1, w_ = 2;  ///< the axes; the last one is projected away
  IntPoint normal_;
  std::deque<Line> lines_;  ///< to which pieces refer
  std::vector<Piece> pieces_;
};

}  // namespace impinge::solid
