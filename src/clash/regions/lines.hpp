// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::clash {

/// A piece of a line of contact, from its lexicographically lower end.
struct Piece {
  Vec3 from, to;
  double flow = 0;  ///< above 0 if the line's direction is from `from` to `to`, below 0 if it is opposite, 0 if unknown
};

/// Pieces joined end to end. The last point of a closed line equals the first.
struct Polyline {
  std::vector<Vec3> points;
  double flow = 0;  ///< the sum over its pieces, along the order of points

  [[nodiscard]] bool closed() const { return points.size() > 3 && points.front() == points.back(); }
};

/// Makes a piece with its ends in order. `flow` is the flow from p to q.
Piece piece(const Vec3& p, const Vec3& q, double flow = 0);

/// Merges equal pieces into one with the sum of their flows.
std::vector<Piece> merged(std::vector<Piece> pieces, const std::stop_token& stop = {});

/// Reduces the number of equal pieces to one or two, keeping it odd or even.
std::vector<Piece> thinned(std::vector<Piece> pieces, const std::stop_token& stop = {});

/// Joins pieces to lines; equal pieces count once. Lines begin and end where an odd number of pieces meet, or else are
/// closed and begin at their lexicographically lowest point. The result depends neither on the order of the pieces nor
/// on the direction of flow.
std::vector<Polyline> joined(std::vector<Piece> pieces, const std::stop_token& stop = {});

/// Compares points lexicographically.
bool less(const Vec3& p, const Vec3& q);

/// Compares pieces by their ends.
bool is_before(const Piece& x, const Piece& y);

}  // namespace impinge::clash
