// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number.hpp"
#include "core/orthogonal.hpp"

// Two convex hulls are apart by more than d at a time if a vector n of length 1 or less has n . (b - a) > d for all
// their corners a and b. Corners move linearly. Let n go linearly from a unit vector at the start of a part of the time
// to another one at its end: its length is never above 1, and n . (b - a) is a quadratic, above d throughout if its
// three Bernstein coefficients are. So parts of the time are found free, one after the other, from time 0 on, each with
// the best vectors at its two ends; since the error of a moving direction is quadratic in the length of a part, they
// are long also where features slide along each other and turn.
//
// Let u = 2^-53, and M the largest component of the points as seen from the first one, at both ends, as computed: each
// is off by u of itself. At a time between they are off by 4 u M more a component, 1 - t and all sums and products
// being rounded; a dot product with n, whose components add up to less than 1.8, is then off by 9 u M and by 5.2 u M of
// its own. The middle coefficient has two of them a corner, with a sum: its half is off by 16 u M; and the difference
// of two, by 36 u M. The length of n is off by 4 u, which counts as 16 u M where d < 4 M; and so does the division by
// a length, once. All this is below kFloor M.
namespace impinge::motion {

namespace {

constexpr double kFloor = 0x1p-46;
constexpr double kRelative = 0x1p-10, kAbsolute = 0x1p-32;

double mixed(double a, double b, double t) { return (1 - t) * a + t * b; }

/// The smallest f(b) - f(a) of points a, the first `kFirst`, and b, the others.
template <std::size_t kFirst, class Value>
double smallest_difference(const Value& f) {
  double a = f(0), b = f(kFirst);
  for (std::size_t i = 1; i < kFirst; ++i) a = std::max(a, f(i));
  for (std::size_t i = kFirst + 1; i < 4; ++i) b = std::min(b, f(i));
  return b - a;
}

/// Two features at one time: the first `kFirst` points, and the others.
template <std::size_t kFirst>
struct Placed {
  FourPoints points;
  Vec3 n{0, 0, 0};          ///< towards the second feature; nothing is a wider slab between the two, but for rounding
  double gap = -kInfinity;  ///< between them along n, a unit vector

  [[nodiscard]] double along(const Vec3& v) const {
    return smallest_difference<kFirst>([&](std::size_t i) { return dot(v, points[i]); });
  }

  /// The direction between nearest points is one of: from a vertex to a vertex; from an edge to a vertex, at right
  /// angles to the edge; at right angles to the face or to both edges. Of all directions it has the widest slab.
  /// What is not at right angles to a long edge by more than rounding would miss by as much as the edge is long: hence
  /// `orthogonal_to`, also for cross products of almost parallel vectors. So the gap falls short of the distance by
  /// some 10 u M: where a corner cuts off more of the slab between two features that are nearest, they are not.
  explicit Placed(const FourPoints& at) : points(at) {
    for (std::size_t i = 0; i < kFirst; ++i)
      for (std::size_t j = kFirst; j < 4; ++j) offer(points[j] - points[i]);
    if constexpr (kFirst == 1) {
      offer_from_edge(0, 1, 2), offer_from_edge(0, 2, 3), offer_from_edge(0, 3, 1);
      // By the longest side, and another one.
      std::size_t longest = 1;
      double most = 0;
      for (std::size_t i = 1; i < 4; ++i) {
        const Vec3 side = points[i % 3 + 1] - points[i];
        if (const double square = dot(side, side); square > most) most = square, longest = i;
      }
      const Vec3 side = points[longest % 3 + 1] - points[longest];
      offer_across(side, points[(longest + 1) % 3 + 1] - points[longest]);
    } else {
      for (const std::size_t i : {0, 1}) offer_from_edge(i, 2, 3), offer_from_edge(2 + i, 0, 1);
      const Vec3 u = points[1] - points[0], v = points[3] - points[2];
      dot(u, u) > dot(v, v) ? offer_across(u, v) : offer_across(v, u);
    }
  }

 private:
  void offer(const Vec3& v) {
    const double vv = dot(v, v);
    if (!(vv > 0x1p-900)) return;  // no direction, or one that was rounded too much
    const double above = along(v), below = along(-1 * v), length = std::sqrt(vv);
    const double value = std::max(above, below) / length;
    if (!(value > gap)) return;
    gap = value;
    n = (above >= below ? 1 / length : -1 / length) * v;
  }
  void offer_from_edge(std::size_t vertex, std::size_t start, std::size_t end) {
    const Vec3 edge = points[end] - points[start], way = points[vertex] - points[start];
    const double along = dot(way, edge);
    if (along > 0 && along < dot(edge, edge)) offer(orthogonal_to(edge, way));
  }
  void offer_across(const Vec3& longer, const Vec3& other) {
    if (dot(longer, longer) > 0x1p-900) offer(orthogonal_to(longer, cross(longer, other)));
  }
};

double largest_component(const FourPoints& points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, max_component(abs(p)));
  return largest;
}

/// The points as seen from the first one, times a power of two that makes most of them 1 to 2.
struct Local {
  FourPoints from, to;
  double size = 0;  ///< the largest component
  double unit = 1;

  Local(const FourPoints& start, const FourPoints& end) {
    const double largest = std::max(largest_component(start), largest_component(end));
    const double quarter = largest > 0x1p1000 ? 0.25 : 1;  // so that no difference overflows
    for (std::size_t i = 0; i < 4; ++i) {
      from[i] = quarter * start[i] - quarter * start[0];
      to[i] = quarter * end[i] - quarter * end[0];
    }
    size = std::max(largest_component(from), largest_component(to));
    if (size == 0) return;
    const double scale = std::ldexp(1.0, std::clamp(-exponent(size), -1000, 1000));
    for (FourPoints* points : {&from, &to})
      for (Vec3& p : *points) p = scale * p;
    size *= scale;
    unit = quarter * scale;
  }
  [[nodiscard]] FourPoints at(double t) const {
    FourPoints points;
    for (std::size_t i = 0; i < 4; ++i)
      points[i] = {mixed(from[i].x, to[i].x, t), mixed(from[i].y, to[i].y, t), mixed(from[i].z, to[i].z, t)};
    return points;
  }
};

template <std::size_t kFirst>
std::optional<Approach> approach(const FourPoints& from, const FourPoints& to, double separation, double end) {
  const Local local(from, to);
  const double d = separation * local.unit, beyond = d + kFloor * local.size;
  double free_until = 0;
  Placed<kFirst> start(local.from);  // then
  const auto found = [&]() -> std::optional<Approach> {
    if (free_until > end) return std::nullopt;
    return Approach{free_until, start.gap > kFloor * local.size ? -1 * start.n : Vec3{0, 0, 0}};
  };
  // No two points are farther from each other than 4 `size`. Whether features are apart at the start depends on where
  // they are then alone, so that each motion that was found free may be followed by any other one.
  if (!(start.gap > d + 2 * kFloor * largest_component(local.from) && d < 4 * local.size)) return found();
  // Features that start within the tolerance are found where they have come nearer: else none could ever part. At the
  // end they are far enough apart to start from there: the gap is off by kFloor `size` here and there, and twice that
  // is asked for then.
  const double tolerance = kRelative * d + kAbsolute * local.size;
  const double near = std::min(d + tolerance / 2, (start.gap + d) / 2 + 4 * kFloor * local.size);
  for (double step = 1; free_until < end;) {
    // A step that moves all points by less than tolerance / 8 is free, unless they were that near at the start.
    if (step < 0x1p-50) {
      free_until = std::max(free_until, std::numeric_limits<double>::min());
      return found();
    }
    const double time = std::min(free_until + step, 1.0);
    const FourPoints points = local.at(time);
    const double along_start = smallest_difference<kFirst>([&](std::size_t i) { return dot(start.n, points[i]); });
    if (along_start > near && time == 1) break;
    const Placed<kFirst> next(points);
    const auto mixed_twice = [&](std::size_t i) { return dot(start.n, points[i]) + dot(next.n, start.points[i]); };
    if (next.gap > beyond && start.gap > beyond &&
        (along_start > beyond || smallest_difference<kFirst>(mixed_twice) > 2 * beyond)) {
      free_until = time, start = next;
      if (!(start.gap > near)) return found();
      if (time == 1) break;
      step *= 2;
    } else {
      // To where the gap along the first direction, a concave function, would be near the separation if it were linear.
      const double share = (start.gap - (near + d) / 2) / (start.gap - along_start);
      step = (time - free_until) * std::clamp(share, 0x1p-4, 1 - 0x1p-4);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Approach> vertex_face_approach(const FourPoints& from, const FourPoints& to, double separation,
                                             double end) {
  return approach<1>(from, to, separation, end);
}

std::optional<Approach> edge_edge_approach(const FourPoints& from, const FourPoints& to, double separation,
                                           double end) {
  return approach<2>(from, to, separation, end);
}

}  // namespace impinge::motion
