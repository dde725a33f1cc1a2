// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/polygon.hpp"

namespace impinge::clash {

Vec3 Polygon::middle() const {
  Vec3 sum{0, 0, 0};
  for (const Vec3& point : *this) sum = sum + point;
  return (1 / static_cast<double>(size_)) * sum;
}

Cut cut(const Polygon& polygon, const HalfSpace& half_space) {
  std::array<double, Polygon::kMost> height;
  bool some_within = false, some_beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    height[i] = dot(half_space.normal, polygon[i]) - half_space.offset;
    some_within |= height[i]<0, some_beyond |= height[i]> 0;
  }
  if (!some_beyond) return {polygon, {}};
  if (!some_within) return {{}, polygon};
  Cut result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = i + 1 == polygon.size() ? 0 : i + 1;
    if (height[i] <= 0) result.within.push(polygon[i]);
    if (height[i] >= 0) result.beyond.push(polygon[i]);
    if ((height[i] < 0 && height[next] > 0) || (height[i] > 0 && height[next] < 0)) {
      const double share = height[i] / (height[i] - height[next]);
      const Vec3 point = polygon[i] + share * (polygon[next] - polygon[i]);
      result.within.push(point), result.beyond.push(point);
    }
  }
  return result;
}

Cut halve(const Polygon& polygon) {
  Vec3 lo = polygon[0], hi = lo;
  for (const Vec3& point : polygon) lo = min(lo, point), hi = max(hi, point);
  const Vec3 extent = hi - lo, middle = 0.5 * (lo + hi);
  if (extent.x >= extent.y && extent.x >= extent.z) return cut(polygon, {{1, 0, 0}, middle.x});
  if (extent.y >= extent.z) return cut(polygon, {{0, 1, 0}, middle.y});
  return cut(polygon, {{0, 0, 1}, middle.z});
}

}  // namespace impinge::clash
