// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "impinge/clash.hpp"
#include "solid/body.hpp"
#include "solid/classed_piece.hpp"

namespace impinge::clash {

/// A placed piece of a part, with what reaching into it is measured by.
struct PlacedPiece {
  solid::Body body;  ///< its triangles, turned
  PartClass part_class = PartClass::surface;
  std::vector<solid::InnerPoint> inner_points;  ///< in the world
  double radius = 0;                            ///< the largest of theirs
  /// Of a cracked piece: its winding numbers and open edges, in `frame` of the mesh that `body` places.
  const solid::TriangleTree* tree = nullptr;
  const solid::TriangleTree* open_edges = nullptr;
  LocalFrame frame{};
  Mat3 to_mesh{};  ///< the inverse of the pose's matrix

  [[nodiscard]] bool has_inside() const { return part_class != PartClass::surface; }
  /// How often it winds around a point, in whatever direction: exactly if it is solid, and 0 on its triangles; 0 for a
  /// surface.
  [[nodiscard]] double winding(const Vec3& point) const;
  [[nodiscard]] bool holds(const Vec3& point) const { return winding(point) > 0.5; }
  /// As `Winding::to_open_edge`.
  [[nodiscard]] double to_open_edge(const Vec3& point, double within) const;

 private:
  [[nodiscard]] Vec3 local(const Vec3& point) const;
};

/// A placed part with its pieces.
struct PlacedPart {
  solid::Body whole;
  std::vector<PlacedPiece> pieces;

  [[nodiscard]] bool has_inside() const;
  [[nodiscard]] double radius() const;                    ///< the largest of its pieces'
  [[nodiscard]] double winding(const Vec3& point) const;  ///< the most of its pieces'
  [[nodiscard]] bool holds(const Vec3& point) const { return winding(point) > 0.5; }
  [[nodiscard]] double to_open_edge(const Vec3& point, double within) const;
  [[nodiscard]] bool is_closed() const;  ///< all pieces are solid
};

/// How deep two parts reach into each other: the most of all pairs of their pieces.
struct PairReach {
  Interval a_in_b, b_in_a;  ///< 0 into a surface; the lesser of the two may be known less precisely
  double crossing = 0;      ///< of two surfaces: how far triangles that cross stand out on both sides of each other
  /// Both of two pieces reach into each other by more than half of the other's radius, or a surface does so into a
  /// piece, or two surfaces are the same.
  bool through = false;

  /// The pair fails at tolerances below this; infinity if at all.
  [[nodiscard]] double fails_below() const;
};

struct ReachGoal {
  /// Of each depth, as in `DepthGoal`; infinity where only the verdicts at these tolerances are asked for.
  double precision = 0.05;
  std::vector<double> levels{};  ///< tolerances that will be asked about; depths below the least need not be told apart
  std::stop_token stop{};
};

PairReach reach_between(const PlacedPart& a, const PlacedPart& b, const ReachGoal& goal);

}  // namespace impinge::clash
