// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "solid/triangle_tree.hpp"

namespace impinge::solid {

/// A point around which a piece winds, and how far it is from the piece's triangles.
struct InnerPoint {
  Vec3 point;
  double radius = 0;
};

/// A piece whose inner points are looked for.
struct InnerSearch {
  const TriangleTree& tree;  ///< its triangles, in local coordinates
  double size;               ///< the diagonal of its box
  bool closed;
  std::stop_token stop{};  ///< once it is requested, nothing more is found

  /// Radii below this part of the size are none: of closed pieces what roundings of the coordinates leave, and of
  /// others, whose cracks are as wide, what single precision leaves.
  [[nodiscard]] double least() const { return (closed ? 0x1p-42 : 0x1p-20) * size; }
};

/// The inner point of a triangle: of the points m + s n and m - s n (m its middle, n its normal, s from the size down
/// by steps of the square root of 2) around which the piece winds by more than 1/2, and which no triangle parts from m,
/// the one farthest from all triangles; from there it goes on, away from the nearest triangle, while that distance
/// grows.
std::optional<InnerPoint> inner_point(const InnerSearch& search, std::uint32_t triangle);

/// Of things with these weights, the one that holds the middle of each of so many equal shares of the whole, in order;
/// one that holds several comes as often. Nothing if there is no weight.
std::vector<std::uint32_t> spread(std::span<const double> weights, std::size_t shares);

/// Up to so many of some triangles, spread over their area; all where there are no more.
std::vector<std::uint32_t> spread_by_area(std::span<const Triangle> triangles, std::span<const std::uint32_t> chosen,
                                          std::size_t most);

/// The largest radius of the inner points of these triangles, 0 if there are none.
double largest_inner_radius(const InnerSearch& search, std::span<const std::uint32_t> triangles);

}  // namespace impinge::solid
