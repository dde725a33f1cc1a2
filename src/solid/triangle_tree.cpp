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

/// A quadratic form: the factors of xx, yy, zz, xy, xz and yz.
using Pairs = std::array<double, 6>;
/// A cubic form: the factors of xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz and xyz.
using Triples = std::array<double, 10>;

/// Those of (n . r) (p . r) and of (n . r) (p . r)^2.
Pairs pairs_of(const Vec3& n, const Vec3& p) {
  return {n.x * p.x, n.y * p.y, n.z * p.z, n.x * p.y + n.y * p.x, n.x * p.z + n.z * p.x, n.y * p.z + n.z * p.y};
}
Triples triples_of(const Vec3& n, const Vec3& p) {
  const double xy = p.x * p.y, xz = p.x * p.z, yz = p.y * p.z;
  return {n.x * p.x * p.x,
          n.y * p.y * p.y,
          n.z * p.z * p.z,
          2 * n.x * xy + n.y * p.x * p.x,
          2 * n.x * xz + n.z * p.x * p.x,
          2 * n.y * xy + n.x * p.y * p.y,
          2 * n.y * yz + n.z * p.y * p.y,
          2 * n.z * xz + n.x * p.z * p.z,
          2 * n.z * yz + n.y * p.z * p.z,
          2 * (n.x * yz + n.y * xz + n.z * xy)};
}
double along(const Pairs& f, const Vec3& r) {
  return r.x * (f[0] * r.x + f[3] * r.y + f[4] * r.z) + r.y * (f[1] * r.y + f[5] * r.z) + f[2] * r.z * r.z;
}
double along(const Triples& f, const Vec3& r) {
  return r.x * r.x * (f[0] * r.x + f[3] * r.y + f[4] * r.z) + r.y * r.y * (f[5] * r.x + f[1] * r.y + f[6] * r.z) +
         r.z * r.z * (f[7] * r.x + f[8] * r.y + f[2] * r.z) + f[9] * r.x * r.y * r.z;
}

template <std::size_t N>
void add(std::array<double, N>& sum, const std::array<double, N>& form, double weight) {
  for (std::size_t i = 0; i < N; ++i) sum[i] += weight * form[i];
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
  eights_.resize((order_.size() + kLeaf - 1) / kLeaf);
  for (std::size_t i = 0; i < kLeaf * eights_.size(); ++i) {
    // What a leaf lacks is filled up with triangles that are points.
    const Triangle& t = triangles_[order_[std::min(i, order_.size() - 1)]];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& v = t[i < order_.size() ? corner : 0];
      auto& [x, y, z] = eights_[i / kLeaf].corners[corner];
      x[i % kLeaf] = v.x, y[i % kLeaf] = v.y, z[i % kLeaf] = v.z;
    }
  }
}

TriangleTree::Node TriangleTree::make_node(std::uint32_t first, std::uint32_t last) const {
  double whole_area = 0, radius = 0, cubes = 0;
  Node node{box_of(triangles_[order_[first]]), first, last, 0, {}, 0, {}, 0, {}, {}, {}};
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
    const Vec3 n = area_vector(t), off = middle_of(t) - node.center;
    node.trace += dot(n, off);
    add(node.pairs, pairs_of(n, off), 1);
    // The mean of a square over a triangle is that of its corners and, nine times, of its middle.
    double largest = 0;
    const auto take = [&](const Vec3& p, double weight) {
      add(node.triples, triples_of(n, p), weight);
      node.linear = node.linear + weight * (2 * dot(n, p) * p + dot(p, p) * n);
    };
    take(off, 9.0 / 12);
    for (const Vec3& vertex : t) {
      take(vertex - node.center, 1.0 / 12);
      largest = std::max(largest, norm(vertex - node.center));
    }
    radius = std::max(radius, largest), cubes += norm(n) * largest * largest * largest;
  }
  node.far = radius + (whole_area > 0 ? 1.25 * std::cbrt(cubes / whole_area) : 0);
  return node;
}

void TriangleTree::build(std::uint32_t first, std::uint32_t last, const std::stop_token& stop) {
  const std::size_t at = nodes_.size();
  nodes_.push_back(make_node(first, last));
  if (last - first <= kLeaf || stop.stop_requested()) return;
  const Vec3 size = nodes_[at].box.hi - nodes_[at].box.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + ((last - first) / 2 + kLeaf - 1) / kLeaf * kLeaf;  // leaves are full, but one
  const auto begin = order_.begin();
  std::nth_element(begin + first, begin + middle, begin + last, [&](std::uint32_t p, std::uint32_t q) {
    return component(middle_of(triangles_[p]), axis) < component(middle_of(triangles_[q]), axis);
  });
  build(first, middle, stop);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last, stop);
}

// 4 pi w is the sum of the integrals of n . g(y - x) over triangles, with g(r) = r / |r|^3, the gradient of -1 / |r|.
// Expanded about the centre c of a cluster, the first three terms are those below. The fourth derivatives of 1 / |r|
// along one direction, and so along any four, are at most 24 / |r|^5, so that the rest is at most the integral of
// 4 |y - c|^3 / (distance - radius)^5: by the rule for which clusters stand for their triangles up to 2.05 of the
// cluster's apparent area, were all of it as far from the centre as the corners and of one sign. As neither is so, it
// is far less: no winding number was ever off by more than 2^-6.
double TriangleTree::winding_number(const Vec3& point) const {
  double sum = 0;
  SolidAngles near;
  Waiting open;
  if (!nodes_.empty()) open.push(0);
  while (!open.is_empty()) {
    const std::uint32_t at = open.pop();
    const Node& node = nodes_[at];
    const Vec3 r = node.center - point;
    const double square = dot(r, r);
    if (square > node.far * node.far) {
      const double distance = std::sqrt(square);
      const double first = node.trace - 3 * along(node.pairs, r) / square;
      const double second = (7.5 * along(node.triples, r) / square - 1.5 * dot(node.linear, r)) / square;
      sum += (dot(node.area, r) + first + second) / (square * distance);
    } else if (node.right == 0) {
      near.add(eights_[node.first / kLeaf], point);
    } else {
      open.push(node.right), open.push(at + 1);
    }
  }
  return (sum + near.sum()) / (4 * std::numbers::pi);
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
