// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/inner_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace impinge::solid {
namespace {

double area_of(const Triangle& t) { return norm(cross(t[1] - t[0], t[2] - t[0])) / 2; }

class NormalSearch {
 public:
  NormalSearch(const InnerSearch& search, const Triangle& triangle)
      : search_(search),
        middle_((1.0 / 3) * (triangle[0] + triangle[1] + triangle[2])),
        normal_(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) {}

  std::optional<InnerPoint> run() {
    const double length = norm(normal_);
    if (!(length > 0)) return std::nullopt;
    normal_ = (1 / length) * normal_;
    // Close to the triangle, winding numbers behind it are one more than before it. A side around which almost nothing
    // winds is outside, and most of the search would be there.
    const double behind = search_.tree.winding_number(middle_ - search_.least() * normal_);
    for (const int side : {-1, 1})
      if (std::abs(side < 0 ? behind : behind - 1) > 0.25) look_along(side * normal_);
    if (best_.radius == 0) return std::nullopt;
    ascend();
    return best_;
  }

 private:
  [[nodiscard]] bool winds_around(const Vec3& point) const {
    return std::abs(search_.tree.winding_number(point)) > 0.5;
  }

  /// A point s along the normal is no farther from triangles than s, nor than the rest of the free way.
  void look_along(const Vec3& direction) {
    const double way = search_.tree.free_way(middle_, direction, search_.least());
    for (double s = search_.size; s > std::max(best_.radius, search_.least()); s /= std::numbers::sqrt2) {
      if (s >= way || way - s <= best_.radius) continue;
      if (search_.stop.stop_requested()) return;
      const Vec3 point = middle_ + s * direction;
      // Along the free way the winding number of a closed piece is one.
      if (search_.closed && !winds_around(point)) return;
      const auto nearest = search_.tree.nearest(point, s * (1 + 0x1p-20));
      if (!nearest || nearest->distance <= std::max(best_.radius, search_.least())) continue;
      if (search_.closed || winds_around(point)) take(point, *nearest);
    }
  }

  void ascend() {
    constexpr int kSteps = 16;
    const auto unit = [](const Vec3& v) { return norm(v) > 0 ? (1 / norm(v)) * v : v; };
    double step = best_.radius / 2;
    Vec3 away = unit(best_.point - nearest_);
    for (int i = 0; i < kSteps && step > best_.radius / 16 && !search_.stop.stop_requested(); ++i) {
      const Vec3 point = best_.point + step * away;
      const auto next = search_.tree.nearest(point, best_.radius + 2 * step);
      if (next && next->distance > best_.radius * (1 + 0x1p-10) && winds_around(point)) {
        take(point, *next);
        away = unit(away + unit(point - next->point));
      } else {
        step /= 2;
        if (next) away = unit(away + unit(point - next->point));
      }
    }
  }

  void take(const Vec3& point, const TriangleTree::Nearest& nearest) {
    best_ = {point, nearest.distance};
    nearest_ = nearest.point;
  }

  const InnerSearch& search_;
  Vec3 middle_, normal_;
  InnerPoint best_;
  Vec3 nearest_{};  ///< to it, of all triangles
};

}  // namespace

std::optional<InnerPoint> inner_point(const InnerSearch& search, std::uint32_t triangle) {
  return NormalSearch(search, search.tree.triangles()[triangle]).run();
}

std::vector<std::uint32_t> spread(std::span<const double> weights, std::size_t shares) {
  const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(shares);
  std::vector<std::uint32_t> held;
  double before = 0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    before += weights[i];
    while (held.size() < shares && before > (static_cast<double>(held.size()) + 0.5) * share) held.push_back(i);
  }
  return held;
}

std::vector<std::uint32_t> spread_by_area(std::span<const Triangle> triangles, std::span<const std::uint32_t> chosen,
                                          std::size_t most) {
  if (chosen.size() <= most) return {chosen.begin(), chosen.end()};
  std::vector<double> areas;
  areas.reserve(chosen.size());
  for (const std::uint32_t t : chosen) areas.push_back(area_of(triangles[t]));
  std::vector<std::uint32_t> held = spread(areas, most);
  held.erase(std::unique(held.begin(), held.end()), held.end());
  for (std::uint32_t& t : held) t = chosen[t];
  return held;
}

double largest_inner_radius(const InnerSearch& search, std::span<const std::uint32_t> triangles) {
  double largest = 0;
  for (const std::uint32_t t : triangles)
    if (const auto found = inner_point(search, t)) largest = std::max(largest, found->radius);
  return largest;
}

}  // namespace impinge::solid
