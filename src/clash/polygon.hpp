// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/vec3.hpp"

/// Convex polygons in space, in floating point: pieces of a triangle. The vertices that a cut makes are off by a few
/// roundings of the coordinates, for which callers leave a margin.
namespace impinge::clash {

/// A convex polygon of a few vertices.
class Polygon {
 public:
  static constexpr std::size_t kFull = 12, kMost = 24;  ///< a cut adds one vertex at most; callers halve a full polygon

  Polygon() = default;
  explicit Polygon(const Triangle& triangle) : points_{triangle[0], triangle[1], triangle[2]}, size_(3) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Vec3* begin() const { return points_.data(); }
  [[nodiscard]] const Vec3* end() const { return points_.data() + size_; }
  [[nodiscard]] const Vec3& operator[](std::size_t i) const { return points_[i]; }
  void push(const Vec3& point) {
    if (size_ == kMost) throw std::length_error("a polygon has too many corners");  // an error, not a fault
    points_[size_++] = point;
  }
  [[nodiscard]] bool is_full() const { return size_ >= kFull; }
  [[nodiscard]] Vec3 middle() const;

 private:
  std::array<Vec3, kMost> points_;
  std::size_t size_ = 0;
};

/// {x : normal . x <= offset}
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// The parts of a polygon within a half space and beyond it; empty ones have no vertices, others one more than the
/// polygon at most, be it convex up to rounding only.
struct Cut {
  Polygon within, beyond;
};
Cut cut(const Polygon& polygon, const HalfSpace& half_space);

/// Cuts a polygon in half across the axis along which it is longest.
Cut halve(const Polygon& polygon);

}  // namespace impinge::clash
