// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/carried_axes.hpp"

#include <algorithm>
#include <cstddef>

namespace impinge::hierarchy {
namespace {

/// The part of a vector that is perpendicular to a unit vector.
Vec3 perpendicular(const Vec3& v, const Vec3& unit) { return v - dot(v, unit) * unit; }

Vec3 normalised(const Vec3& v) { return (1 / norm(v)) * v; }

}  // namespace

void carry_axes(const RefitPlan::Axes& from, std::span<const RefitPlan::Sample> samples, const Vec3* points,
                Frame& to) {
  Mat3 carried{};
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Vec3 moved = points[k] - points[0];
    for (std::size_t i = 0; i < 3; ++i) carried[i] = carried[i] + double{samples[k].coefficient[i]} * moved;
  }
  const double squares[3] = {dot(carried[0], carried[0]), dot(carried[1], carried[1]), dot(carried[2], carried[2])};
  const auto first = static_cast<std::size_t>(std::max_element(squares, squares + 3) - squares);
  if (!(squares[first] > 0x1p-600 && squares[first] < 0x1p600)) {  // all is or was in one point
    std::copy(&from.axes[0][0], &from.axes[0][0] + 12, &to.axes[0][0]);
    return;
  }
  const auto old_axis = [&](int i) { return Vec3{from.axes[0][i], from.axes[1][i], from.axes[2][i]}; };
  Mat3 axes;
  axes[first] = normalised(carried[first]);
  const std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
  const Vec3 rest[2] = {perpendicular(carried[second], axes[first]), perpendicular(carried[third], axes[first])};
  const bool exchange = dot(rest[1], rest[1]) > dot(rest[0], rest[0]);
  Vec3 other = rest[exchange ? 1 : 0];
  if (!(dot(other, other) > 0x1p-40 * squares[first])) {  // all is on one line
    for (int i = 0; i < 3; ++i) {
      const Vec3 old = perpendicular(old_axis(i), axes[first]);
      if (i == 0 || dot(old, old) > dot(other, other)) other = old;
    }
  }
  other = normalised(other);  // to within 2^-30 perpendicular to the first axis
  axes[exchange ? third : second] = other, axes[exchange ? second : third] = cross(axes[first], other);
  const bool was_right_handed = dot(cross(old_axis(0), old_axis(1)), old_axis(2)) > 0;
  if (was_right_handed == exchange) axes[exchange ? second : third] = -1 * axes[exchange ? second : third];
  for (std::size_t i = 0; i < 3; ++i) {
    to.axes[0][i] = static_cast<float>(axes[i].x), to.axes[1][i] = static_cast<float>(axes[i].y);
    to.axes[2][i] = static_cast<float>(axes[i].z);
  }
  for (auto& component : to.axes) component[3] = 0;
}

}  // namespace impinge::hierarchy
