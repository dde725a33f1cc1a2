// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/bounding_sphere.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

#include "core/number.hpp"

namespace impinge::scene {
namespace {

/// The sphere through all of at most four points with its centre in their affine hull.
Sphere circumsphere(std::span<const Vec3> points) {
  const auto n = static_cast<Eigen::Index>(points.size()) - 1;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram(n, n);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> half_squares(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 d = points[i + 1] - points[0];
    half_squares(i) = 0.5 * dot(d, d);
    for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = dot(d, points[j + 1] - points[0]);
  }
  const auto weights = gram.fullPivLu().solve(half_squares).eval();
  Vec3 offset{0, 0, 0};
  for (Eigen::Index i = 0; i < n; ++i) offset = offset + weights(i) * (points[i + 1] - points[0]);
  return {points[0] + offset, norm(offset)};
}

/// The smallest sphere around at most five points, the last of which is on its border. `points` becomes the subset that
/// spans it: every subset is tried.
Sphere smallest_sphere(std::vector<Vec3>& points) {
  constexpr double kSlack = 1 + 1e-9;
  const std::size_t last = points.size() - 1;
  Sphere best{{}, std::numeric_limits<double>::infinity()};
  std::vector<Vec3> best_support;
  for (unsigned subset = 1; subset < 1u << last; ++subset) {
    if (std::popcount(subset) > 3) continue;
    std::vector<Vec3> support{points[last]};
    for (std::size_t i = 0; i < last; ++i)
      if (subset >> i & 1) support.push_back(points[i]);
    const Sphere sphere = circumsphere(support);
    const auto inside = [&](const Vec3& p) { return norm(p - sphere.center) <= kSlack * sphere.radius; };
    if (sphere.radius < best.radius && std::all_of(points.begin(), points.end(), inside)) {
      best = sphere;
      best_support = std::move(support);
    }
  }
  points = std::move(best_support);
  return best;
}

/// Of a point from a centre, in other units.
struct Offset {
  Vec3 middle;
  double scale;
  Vec3 center;

  Vec3 operator()(const Vec3& p) const { return scale * (p - middle) - center; }
};

/// The point of greatest |offset|, the first of several.
class FarthestPoint {
 public:
  FarthestPoint(std::span<const Vec3> points, const VertexNumbers& numbers)
      : points_(points), boxes_(numbers.boxes), bounds_(boxes_.size()) {}

  const Vec3& operator()(const Offset& offset) {
    // Rounding is monotonic: by the same operations, the farthest corner of a run's box is at least as far as each
    // point in it, as computed.
    for (std::size_t run = 0; run < boxes_.size(); ++run) {
      const Vec3 d = max(abs(offset(boxes_[run].lo)), abs(offset(boxes_[run].hi)));
      bounds_[run] = dot(d, d);
    }
    const auto square_of = [&](std::size_t run) {
      return greatest_square(points_of(run), offset.middle, offset.scale, offset.center);
    };
    // Runs that lie nearer than some point need not be looked at.
    double least = square_of(static_cast<std::size_t>(std::ranges::max_element(bounds_) - bounds_.begin()));
    double greatest = -1;
    std::size_t found = 0;
    for (std::size_t run = 0; run < bounds_.size(); ++run) {
      if (bounds_[run] < least) continue;
      if (const double square = square_of(run); square > greatest) greatest = square, found = run;
      least = std::max(least, greatest);
    }
    return *std::ranges::find_if(points_of(found),
                                 [&](const Vec3& p) { return dot(offset(p), offset(p)) == greatest; });
  }

 private:
  [[nodiscard]] std::span<const Vec3> points_of(std::size_t run) const {
    const std::size_t first = run * VertexNumbers::kRun;
    return points_.subspan(first, std::min(VertexNumbers::kRun, points_.size() - first));
  }

  std::span<const Vec3> points_;
  std::span<const Box> boxes_;
  std::vector<double> bounds_;
};

}  // namespace

Sphere bounding_sphere(std::span<const Vec3> points, const VertexNumbers& numbers) {
  if (points.empty()) return {};
  const Box box = numbers.box();
  const Vec3 middle = 0.5 * box.lo + 0.5 * box.hi;
  const double extent = max_component(0.5 * box.hi - 0.5 * box.lo);
  if (extent == 0) return {points[0], 0};
  // Squares and their products would leave the range of double at the borders of the domain: work in units of the
  // extent.
  const int magnitude = std::clamp(exponent(extent), -1000, 1000);
  const double unit = std::ldexp(1.0, magnitude), inverse_unit = std::ldexp(1.0, -magnitude);
  const auto scaled = [&](const Vec3& p) { return inverse_unit * (p - middle); };
  FarthestPoint farthest_by(points, numbers);
  const auto farthest_from = [&](const Vec3& center) { return scaled(farthest_by({middle, inverse_unit, center})); };

  // Each round puts the farthest point on the border of the sphere around the support, so the sphere grows; it is the
  // smallest as soon as no point is outside (Gärtner, "Fast and Robust Smallest Enclosing Balls", 1999). Rounding may
  // stall it: the rounds are bounded.
  constexpr int kRounds = 64;
  std::vector<Vec3> support{farthest_from({0, 0, 0})};
  support.push_back(farthest_from(support[0]));
  Sphere sphere = circumsphere(support);
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 farthest = farthest_from(sphere.center);
    if (norm(farthest - sphere.center) <= sphere.radius * (1 + 1e-12)) break;
    support.push_back(farthest);
    const Sphere next = smallest_sphere(support);
    if (!(next.radius > sphere.radius && next.radius < 4)) break;
    sphere = next;
  }

  // Whatever rounding did to the centre, the radius reaches every point: a difference, a norm and a product are off by
  // less than 8 eps.
  const Vec3 center = middle + unit * sphere.center;
  const Offset offset{center, inverse_unit, {}};
  const double radius = norm(offset(farthest_by(offset)));
  return {center, unit * (radius * (1 + 0x1p-49))};
}

}  // namespace impinge::scene
