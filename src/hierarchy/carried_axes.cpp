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

void carry_axes(const Mat3& carried, const Frame& from, Frame& to) {
  const double lengths[3] = {norm(carried[0]), norm(carried[1]), norm(carried[2])};
  const auto first = static_cast<std::size_t>(std::max_element(lengths, lengths + 3) - lengths);
  if (!(lengths[first] > 0x1p-300 && lengths[first] < 0x1p300)) {  // all is or was in one point
    std::copy(&from.axes[0][0], &from.axes[0][0] + 12, &to.axes[0][0]);
    return;
  }
  Mat3 axes;
  axes[first] = normalised(carried[first]);
  std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
  const Vec3 rest[2] = {perpendicular(carried[second], axes[first]), perpendicular(carried[third], axes[first])};
  const bool exchange = norm(rest[1]) > norm(rest[0]);
  Vec3 other = rest[exchange ? 1 : 0];
  if (!(norm(other) > 0x1p-20 * lengths[first])) {  // all is on one line
    for (int i = 0; i < 3; ++i) {
      const Vec3 old = perpendicular(axis_of(from, i), axes[first]);
      if (i == 0 || norm(old) > norm(other)) other = old;
    }
  }
  // Once more: the first time rounding may leave 2^-30 of the first axis.
  other = normalised(perpendicular(normalised(other), axes[first]));
  axes[exchange ? third : second] = other, axes[exchange ? second : third] = cross(axes[first], other);
  const bool was_right_handed = dot(cross(axis_of(from, 0), axis_of(from, 1)), axis_of(from, 2)) > 0;
  if (was_right_handed == exchange) axes[exchange ? second : third] = -1 * axes[exchange ? second : third];
  for (std::size_t i = 0; i < 3; ++i) {
    to.axes[0][i] = static_cast<float>(axes[i].x), to.axes[1][i] = static_cast<float>(axes[i].y);
    to.axes[2][i] = static_cast<float>(axes[i].z);
  }
  for (auto& component : to.axes) component[3] = 0;
}

/// By the linear map that fits best, in least squares, some of the corners: the first of each triangle are enough.
/// Where nothing has moved nothing turns.
void carry_leaf_axes(const WideLeaf& old, const double* points, Frame& to) {
  const std::size_t stride = old.stride, size = 3 * stride;
  const int corners = old.count < 4 ? 3 : 1;
  const std::size_t step = (old.count + 6) / 7;
  double n = 0;
  Vec3 sum_old{}, sum{}, squares{}, products{};  // products of y z, z x and x y
  Mat3 both{};
  for (int corner = 0; corner < corners; ++corner) {
    const float *const x = old.row(3 * corner), *const y = x + stride, *const z = y + stride;
    const double* const at = points + static_cast<std::size_t>(corner) * stride;
    for (std::size_t t = 0; t < old.count; t += step) {
      const Vec3 was{x[t], y[t], z[t]}, is{at[t], at[size + t], at[2 * size + t]};
      n += 1, sum_old = sum_old + was, sum = sum + is;
      squares = squares + Vec3{was.x * was.x, was.y * was.y, was.z * was.z};
      products = products + Vec3{was.y * was.z, was.z * was.x, was.x * was.y};
      both[0] = both[0] + was.x * is, both[1] = both[1] + was.y * is, both[2] = both[2] + was.z * is;
    }
  }
  const Vec3 mean = (1 / n) * sum_old;
  both[0] = both[0] - mean.x * sum, both[1] = both[1] - mean.y * sum, both[2] = both[2] - mean.z * sum;
  squares = squares - Vec3{mean.x * sum_old.x, mean.y * sum_old.y, mean.z * sum_old.z};
  products = products - Vec3{mean.y * sum_old.z, mean.z * sum_old.x, mean.x * sum_old.y};
  // Across a plane or a line the map is open; the least of these makes it 0 there.
  const double least = 0x1p-20 * (squares.x + squares.y + squares.z);
  const Vec3 diagonal = squares + Vec3{least, least, least};
  const Mat3 covariance{Vec3{diagonal.x, products.z, products.y}, Vec3{products.z, diagonal.y, products.x},
                        Vec3{products.y, products.x, diagonal.z}};
  carry_axes(inverse(covariance) * both, old.frame, to);
}

}  // namespace impinge::hierarchy
