// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/polygon.hpp"

#include <algorithm>

namespace impinge::clash {
namespace {

using Heights = std::array<double, Polygon::kMost>;

/// Flattens corners that rise above the plane again on the way from the highest corner to the lowest.
void keep_below(Heights& height, std::size_t from, std::size_t to, std::size_t step, std::size_t size) {
  bool is_below = false;
  for (std::size_t i = from; i != to; i = (i + step) % size) {
    is_below |= height[i] < 0;
    if (is_below && height[i] > 0) height[i] = 0;
  }
}

/// Around a convex polygon heights fall once and rise once. Where they do not, rounding has made the polygon not quite
/// convex, and the corners in question lie on the plane up to rounding. With these at height 0 a plane meets two edges
/// at most.
void keep_one_fall(Heights& height, std::size_t size) {
  std::size_t above = 0, below = 0;  // runs
  for (std::size_t i = 0; i < size; ++i) {
    const double next = height[i + 1 == size ? 0 : i + 1];
    above += height[i] > 0 && !(next > 0) ? 1U : 0U;
    below += height[i] < 0 && !(next < 0) ? 1U : 0U;
  }
  if (above <= 1 && below <= 1) return;
  const auto end = height.begin() + static_cast<std::ptrdiff_t>(size);
  const auto top = static_cast<std::size_t>(std::max_element(height.begin(), end) - height.begin());
  const auto bottom = static_cast<std::size_t>(std::min_element(height.begin(), end) - height.begin());
  keep_below(height, top, bottom, 1, size);
  keep_below(height, top, bottom, size - 1, size);
}

}  // namespace

Vec3 Polygon::middle() const {
  Vec3 sum{0, 0, 0};
  for (const Vec3& point : *this) sum = sum + point;
  return (1 / static_cast<double>(size_)) * sum;
}

Cut cut(const Polygon& polygon, const HalfSpace& half_space) {
  Heights height;
  bool some_within = false, some_beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    height[i] = dot(half_space.normal, polygon[i]) - half_space.offset;
    some_within |= height[i]<0, some_beyond |= height[i]> 0;
  }
  if (!some_beyond) return {polygon, {}};
  if (!some_within) return {{}, polygon};
  keep_one_fall(height, polygon.size());
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
