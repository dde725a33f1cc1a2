// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/vec3.hpp"

namespace impinge::clash {

/// A piece of a line of contact, from its lexicographically lower end.
struct Piece {
  Vec3 from, to;
  double flow = 0;  ///< above 0 if the line's own direction is from `from` to `to`, below if the other way; 0: unknown
};

/// Pieces one behind the other. One that is closed ends with the point that it begins with.
struct Polyline {
  std::vector<Vec3> points;
  double flow = 0;  ///< of its pieces, summed up along its points

  [[nodiscard]] bool closed() const { return points.size() > 3 && points.front() == points.back(); }
};

/// Makes a piece whose ends are in order. `flow` is that from p to q.
Piece piece(const Vec3& p, const Vec3& q, double flow = 0);

/// Equal pieces become one, with the flows of all.
std::vector<Piece> merged(std::vector<Piece> pieces);

/// Of equal pieces one or two remain, so that it can still be told whether they were odd in number.
std::vector<Piece> thinned(std::vector<Piece> pieces);

/// Each piece is used once, however often it is given. Lines begin and end where an odd number of pieces meet, or else
/// are closed and begin at their lexicographically lowest point. The answer does not depend on the pieces' order, nor
/// on which way their lines flow.
std::vector<Polyline> joined(std::vector<Piece> pieces);

/// Lexicographic.
bool less(const Vec3& p, const Vec3& q);

}  // namespace impinge::clash
