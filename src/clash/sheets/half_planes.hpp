// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec3.hpp"
#include "exact/rational.hpp"

/// The exact order of triangles around a line in their planes: points along the line are rational numbers, and the
/// order around it follows from signs.
namespace impinge::clash {

/// A line through two different points, in the direction from the first to the second.
class Line {
 public:
  Line(const Vec3& from, const Vec3& to);
  [[nodiscard]] const Vec3& from() const { return from_; }
  [[nodiscard]] const Vec3& to() const { return to_; }
  /// Grows along the line.
  [[nodiscard]] exact::Rational along(const Vec3& p) const { return place(p); }
  /// The same of a point that is given by doubles: one of its coordinates or minus that.
  [[nodiscard]] double place(const Vec3& p) const { return backward_ ? -component(p, axis_) : component(p, axis_); }

 private:
  Vec3 from_, to_;
  int axis_;
  bool backward_;
};

/// A half-plane bounded by a line, which holds a triangle next to the line.
struct HalfPlane {
  std::uint32_t triangle;  ///< a number that the caller chose
  Vec3 toward;             ///< a point of the half-plane that is not on the line
  bool ahead_is_front;     ///< the triangle's front faces counterclockwise
};

/// What a proper triangle shares with a line: a segment. Inside the triangle it has a half-plane on either side, along
/// an edge one.
struct Stretch {
  exact::Rational lo, hi;
  std::vector<HalfPlane> half_planes;
};
/// Nothing if they share a point or none.
std::optional<Stretch> stretch_of(const Line& line, const Triangle& triangle, std::uint32_t number);

/// Counterclockwise as seen against the line's direction; those in one half-plane make one entry.
std::vector<std::vector<HalfPlane>> in_order(const Line& line, const std::vector<HalfPlane>& half_planes);

}  // namespace impinge::clash
