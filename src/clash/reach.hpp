// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/local_frame.hpp"
#include "impinge/clash.hpp"
#include "solid/body.hpp"
#include "solid/inner_points.hpp"
#include "solid/triangle_tree.hpp"

namespace impinge::clash {

/// A placed piece of a part, with what reaching into it is measured by.
struct PlacedPiece {
  solid::Body body;  ///< its triangles, turned
  PartClass part_class = PartClass::surface;
  std::vector<solid::InnerPoint> inner_points;  ///< in the world
  double radius = 0;                            ///< the largest of theirs
  /// Of a cracked piece: its winding numbers, about points in a frame of its own.
  std::optional<solid::TriangleTree> tree{};
  LocalFrame frame{};

  [[nodiscard]] bool has_inside() const { return part_class != PartClass::surface; }
  /// How often it winds around a point, in whatever direction: exactly if it is solid, and 0 on its triangles; 0 for a
  /// surface.
  [[nodiscard]] double winding(const Vec3& point) const;
  [[nodiscard]] bool holds(const Vec3& point) const { return winding(point) > 0.5; }
};

/// A placed part with its pieces.
struct PlacedPart {
  solid::Body whole;
  std::vector<PlacedPiece> pieces;

  [[nodiscard]] bool has_inside() const;
  [[nodiscard]] double radius() const;                    ///< the largest of its pieces'
  [[nodiscard]] double winding(const Vec3& point) const;  ///< the most of its pieces'
  [[nodiscard]] bool holds(const Vec3& point) const { return winding(point) > 0.5; }
};

/// How deep two parts reach into each other: the most of all pairs of their pieces.
struct PairReach {
  Interval a_in_b, b_in_a;                      ///< 0 into a surface
  Interval triangles_a_in_b, triangles_b_in_a;  ///< the same of triangles alone
  double crossing = 0;  ///< of two surfaces: how far triangles that cross stand out on both sides of each other
  /// Both of two pieces reach into each other by more than half of the other's radius, or a surface does so into a
  /// piece, or two surfaces are the same.
  bool through = false;

  /// The pair fails at tolerances below this; infinity if at all.
  [[nodiscard]] double fails_below() const;
};

struct ReachGoal {
  double precision = 0.05;  ///< of each depth, as in `DepthGoal`
  std::stop_token stop{};
};

PairReach reach_between(const PlacedPart& a, const PlacedPart& b, const ReachGoal& goal);

}  // namespace impinge::clash
