// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <utility>

namespace impinge::solid {
namespace {

/// Nodes that wait for their turn. Halves are equal to one, so that a tree has 32 levels at most, with one node waiting
/// on each.
class Waiting {
 public:
  void push(std::uint32_t node) { nodes_[size_++] = node; }
  std::uint32_t pop() { return nodes_[--size_]; }
  [[nodiscard]] bool is_empty() const { return size_ == 0; }

 private:
  std::array<std::uint32_t, 40> nodes_;
  std::size_t size_ = 0;
};

Vec3 area_vector(const Triangle& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }
Vec3 middle_of(const Triangle& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

/// Half of the solid angle of a triangle is the angle of this complex number, positive behind the triangle (Van
/// Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983).
struct HalfAngle {
  double x, y;
};
HalfAngle half_angle(const Triangle& t, const Vec3& from) {
  const Vec3 a = t[0] - from, b = t[1] - from, c = t[2] - from;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return {la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb, dot(a, cross(b, c))};
}

double distance_to(const Box& box, const Vec3& p) { return norm(max(max(box.lo - p, p - box.hi), Vec3{0, 0, 0})); }

/// The point of a segment nearest to p.
Vec3 nearest_of(const Vec3& from, const Vec3& to, const Vec3& p) {
  const Vec3 along = to - from;
  const double square = dot(along, along);
  const double s = square > 0 ? std::clamp(dot(along, p - from) / square, 0.0, 1.0) : 0;
  return from + s * along;
}

/// The point of a triangle nearest to p: the foot on its plane, if that lies within all sides, or else on a side.
Vec3 nearest_of(const Triangle& t, const Vec3& p) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double square = dot(normal, normal);
  bool is_over = square > 0;
  for (std::size_t i = 0; i < 3 && is_over; ++i) is_over = dot(cross(normal, t[(i + 1) % 3] - t[i]), p - t[i]) >= 0;
  if (is_over) return p - (dot(normal, p - t[0]) / square) * normal;
  Vec3 best = nearest_of(t[0], t[1], p);
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3 other = nearest_of(t[i], t[(i + 1) % 3], p);
    if (dot(other - p, other - p) < dot(best - p, best - p)) best = other;
  }
  return best;
}

/// Where a ray enters a box; infinity if it does not. A ray along a face of the box may miss it by rounding, as it may
/// miss a triangle.
double entry(const Box& box, const Vec3& from, const Vec3& direction) {
  double lo = 0, hi = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = component(from, axis), speed = component(direction, axis);
    const double p = component(box.lo, axis) - at, q = component(box.hi, axis) - at;
    if (speed == 0) {
      if (p > 0 || q < 0) return kInfinity;
      continue;
    }
    lo = std::max(lo, std::min(p / speed, q / speed)), hi = std::min(hi, std::max(p / speed, q / speed));
  }
  return lo <= hi * (1 + 0x1p-40) ? lo : kInfinity;
}

/// Where a ray meets a triangle (Moller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
double meeting(const Triangle& t, const Vec3& from, const Vec3& direction) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], to = from - t[0];
  const Vec3 across = cross(direction, v);
  const double determinant = dot(u, across);
  if (determinant == 0) return kInfinity;
  const double at_u = dot(to, across) / determinant;
  const Vec3 turned = cross(to, u);
  const double at_v = dot(direction, turned) / determinant;
  if (!(at_u >= 0 && at_v >= 0 && at_u + at_v <= 1)) return kInfinity;
  return dot(v, turned) / determinant;
}

}  // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles, const std::stop_token& stop)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(triangles_.size() / 2 + 1);
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), stop);
}

TriangleTree::Node TriangleTree::make_node(std::uint32_t first, std::uint32_t last) const {
  double whole_area = 0;
  Node node{box_of(triangles_[order_[first]]), first, last, 0, {}, 0, 0, {}, {}};
  for (std::uint32_t i = first; i < last; ++i) {
    const Triangle& t = triangles_[order_[i]];
    const Box box = box_of(t);
    const double area = norm(area_vector(t));
    node.box = {min(node.box.lo, box.lo), max(node.box.hi, box.hi)};
    node.area = node.area + area_vector(t), node.center = node.center + area * middle_of(t);
    whole_area += area;
  }
  node.center = whole_area > 0 ? (1 / whole_area) * node.center : middle_of(triangles_[order_[first]]);
  for (std::uint32_t i = first; i < last; ++i) {
    const Triangle& t = triangles_[order_[i]];
    const Vec3 normal = area_vector(t), off = middle_of(t) - node.center;
    for (int axis = 0; axis < 3; ++axis)
      node.moment[static_cast<std::size_t>(axis)] =
          node.moment[static_cast<std::size_t>(axis)] + component(normal, axis) * off;
    double squares = 9 * dot(off, off);
    for (const Vec3& vertex : t) {
      const double square = dot(vertex - node.center, vertex - node.center);
      squares += square, node.radius = std::max(node.radius, std::sqrt(square));
    }
    node.spread += norm(normal) * squares / 12;
  }
  if (whole_area > 0) node.spread /= whole_area;
  return node;
}

void TriangleTree::build(std::uint32_t first, std::uint32_t last, const std::stop_token& stop) {
  const std::size_t at = nodes_.size();
  nodes_.push_back(make_node(first, last));
  if (last - first <= kLeaf || stop.stop_requested()) return;
  const Vec3 size = nodes_[at].box.hi - nodes_[at].box.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  const auto begin = order_.begin();
  std::nth_element(begin + first, begin + middle, begin + last, [&](std::uint32_t p, std::uint32_t q) {
    return component(middle_of(triangles_[p]), axis) < component(middle_of(triangles_[q]), axis);
  });
  build(first, middle, stop);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last, stop);
}

// 4 pi w is the sum of the integrals of n . g(y - x) over triangles, with g(r) = r / |r|^3, the gradient of -1 / |r|.
// Expanded about the centre c of a cluster, the first two terms are those below. The third derivatives of 1 / |r| along
// one direction, and so along any three, are at most 6 / |r|^4, so that the rest is at most the integral of
// 3 |y - c|^2 / (distance - radius)^4: 3/32 of the cluster's apparent area, by the rule for which clusters stand for
// their triangles. Signs and centres make it far less: no winding number was ever off by more than 2^-6.
double TriangleTree::winding_number(const Vec3& point) const {
  constexpr double kMostSpread = 0x1p-5;
  double sum = 0;
  Waiting open;
  if (!nodes_.empty()) open.push(0);
  while (!open.is_empty()) {
    const std::uint32_t at = open.pop();
    const Node& node = nodes_[at];
    const Vec3 r = node.center - point;
    const double distance = norm(r), clear = distance - node.radius;
    if (clear > 0 && node.spread <= kMostSpread * clear * clear) {
      const double cube = distance * distance * distance;
      const Vec3 along{dot(node.moment[0], r), dot(node.moment[1], r), dot(node.moment[2], r)};
      const double trace = node.moment[0].x + node.moment[1].y + node.moment[2].z;
      sum += (dot(node.area, r) + trace - 3 * dot(along, r) / (distance * distance)) / cube;
    } else if (node.right == 0) {
      sum += solid_angle(node, point);
    } else {
      open.push(node.right), open.push(at + 1);
    }
  }
  return sum / (4 * std::numbers::pi);
}

/// Angles of no more than a quarter of pi are added up by multiplying their numbers, four at a time: most of the time
/// would go into arctangents.
double TriangleTree::solid_angle(const Node& leaf, const Vec3& from) const {
  HalfAngle product{1, 0};
  double sum = 0;
  int factors = 0;
  for (std::uint32_t i = leaf.first; i < leaf.last; ++i) {
    const HalfAngle next = half_angle(triangles_[order_[i]], from);
    if (!(next.x >= std::abs(next.y))) {
      sum += std::atan2(next.y, next.x);
      continue;
    }
    product = {product.x * next.x - product.y * next.y, product.x * next.y + product.y * next.x};
    if (++factors % 4 != 0) continue;
    sum += std::atan2(product.y, product.x);
    product = {1, 0};
  }
  return 2 * (sum + std::atan2(product.y, product.x));
}

std::optional<TriangleTree::Nearest> TriangleTree::nearest(const Vec3& point, double within) const {
  std::optional<Nearest> best;
  double limit = within;
  Waiting open;
  if (!nodes_.empty()) open.push(0);
  while (!open.is_empty()) {
    const std::uint32_t at = open.pop();
    const Node& node = nodes_[at];
    if (distance_to(node.box, point) > limit) continue;
    if (node.right != 0) {
      const bool left_first = distance_to(nodes_[at + 1].box, point) <= distance_to(nodes_[node.right].box, point);
      open.push(left_first ? node.right : at + 1), open.push(left_first ? at + 1 : node.right);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const Vec3 found = nearest_of(triangles_[order_[i]], point);
      const double distance = norm(found - point);
      if (!(distance <= limit)) continue;
      limit = distance;
      best = Nearest{distance, found};
    }
  }
  return best;
}

double TriangleTree::free_way(const Vec3& from, const Vec3& direction, double least) const {
  double way = kInfinity;
  Waiting open;
  if (!nodes_.empty()) open.push(0);
  while (!open.is_empty()) {
    const std::uint32_t at = open.pop();
    const Node& node = nodes_[at];
    if (!(entry(node.box, from, direction) < way)) continue;
    if (node.right != 0) {
      open.push(node.right), open.push(at + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const double at_triangle = meeting(triangles_[order_[i]], from, direction);
      if (at_triangle > least) way = std::min(way, at_triangle);
    }
  }
  return way;
}

}  // namespace impinge::solid
