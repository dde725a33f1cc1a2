// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/degenerate_cells.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "exact/rational.hpp"
#include "exact/segment.hpp"
#include "solid/cells.hpp"
#include "solid/locate.hpp"

namespace impinge::solid {
namespace {

using exact::Rational;
using exact::RationalPoint;

RationalPoint difference(const RationalPoint& p, const RationalPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
RationalPoint cross(const RationalPoint& p, const RationalPoint& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
Rational dot(const RationalPoint& p, const RationalPoint& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// A segment, and the shares of its length at which it is cut. Unnecessary cuts do no harm.
class CutSegment {
 public:
  explicit CutSegment(const Segment& segment) : from_(exact::rational(segment[0])), to_(exact::rational(segment[1])) {
    while (axis_ < 2 && from_[axis_] == to_[axis_]) ++axis_;
  }

  /// Cuts the segment at the triangle's plane; within the plane at the lines of its edges, and level with its vertices.
  void cut_by(const Triangle& t) {
    const std::array corners{exact::rational(t[0]), exact::rational(t[1]), exact::rational(t[2])};
    const RationalPoint normal = cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
    const Rational p = dot(normal, difference(from_, corners[0])), q = dot(normal, difference(to_, corners[0]));
    if (!p.is_zero() || !q.is_zero()) return cut_between(p, q);
    for (std::size_t i = 0; i < 3; ++i) {
      const RationalPoint along = difference(corners[(i + 1) % 3], corners[i]);
      const RationalPoint turn_p = cross(along, difference(from_, corners[i]));
      const RationalPoint turn_q = cross(along, difference(to_, corners[i]));
      for (std::size_t k = 0; k < 3; ++k) cut_between(turn_p[k], turn_q[k]);
      if (from_[axis_] != to_[axis_]) cut_at((corners[i][axis_] - from_[axis_]) / (to_[axis_] - from_[axis_]));
    }
  }

  /// A point of each open piece.
  [[nodiscard]] std::vector<RationalPoint> points() {
    std::sort(shares_.begin(), shares_.end());
    shares_.erase(std::unique(shares_.begin(), shares_.end()), shares_.end());
    std::vector<RationalPoint> points;
    for (std::size_t i = 0; i + 1 < shares_.size(); ++i) {
      const Rational share = (shares_[i] + shares_[i + 1]) / 2;
      RationalPoint point;
      for (std::size_t k = 0; k < 3; ++k) point[k] = from_[k] + share * (to_[k] - from_[k]);
      points.push_back(std::move(point));
    }
    return points;
  }

 private:
  /// Cuts where a linear function is 0 that is p at one end and q at the other.
  void cut_between(const Rational& p, const Rational& q) {
    if (p.sign() * q.sign() < 0) shares_.emplace_back(p / (p - q));
  }
  void cut_at(const Rational& share) {
    if (share.sign() > 0 && share < 1) shares_.push_back(share);
  }

  RationalPoint from_, to_;
  std::size_t axis_ = 0;  ///< an axis along which the ends differ, unless they are equal
  std::vector<Rational> shares_{0, 1};
};

/// The bit of a point; 0 on the boundary of a solid.
std::uint8_t location_of(const RationalPoint& point, const Part& other) {
  const Around found = around(other.body.placed, point);
  if (!other.solid) return found.holders.empty() ? kOutside : kSameSide;
  const auto is_boundary = [&](std::uint32_t t) { return other.is_boundary(t); };
  if (std::any_of(found.holders.begin(), found.holders.end(), is_boundary)) return 0;
  return found.beside != 0 ? kInside : kOutside;
}

}  // namespace

std::uint8_t cells_of_degenerate(const Triangle& degenerate, const Part& other,
                                 const std::vector<std::uint32_t>& touching) {
  const Segment segment = exact::extremes(degenerate);
  if (touching.empty() || segment[0] == segment[1]) return location_of(exact::rational(segment[0]), other);
  CutSegment cut(segment);
  for (const std::uint32_t t : touching) cut.cut_by(other.body.triangle(t));
  std::uint8_t bits = 0;
  for (const RationalPoint& point : cut.points()) bits |= location_of(point, other);
  return bits;
}

}  // namespace impinge::solid
