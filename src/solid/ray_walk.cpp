// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/ray_walk.hpp"

#include <array>
#include <cmath>
#include <span>

#include "core/pose.hpp"

namespace impinge::solid {
namespace {

using hierarchy::Frame;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;
using hierarchy::WideNode;

/// A ray in the tree's unit, in the frame of the mesh or of a node. Triangles that the exact ray meets are within
/// `slack` of this one, in every coordinate.
struct Ray {
  Vec3 start, direction;
  double slack;
};

// A triangle's point w = R y + t + e on the ray, with e the rounding of world vertices (contract 1.1), is start + f + s
// x̂ with f what the start is off: y = R⁻¹(start - t) + s R⁻¹x̂ + R⁻¹(f - e). With u = 2^-53 and S the sum of the
// mesh's, the start's and the translation's magnitudes (1-norms), and R within 1e-6 of a rotation, at most
//    8 u S  in R⁻¹e: 4.01 u a coordinate of |R||x| + |t|, times sqrt 3,
//    8 u S  in R⁻¹f: 4 u a coordinate of the start, times sqrt 3,
//   24 u S  in R⁻¹(start - t): adjugate, quotient, difference,
// 40 u S in all, and 2^-47 S = 64 u S is taken; what the direction is off is counted in `in_frame`. Powers of two scale
// without rounding; what they push below 2^-1022 is far below 2^-100 of the mesh's extent.
Ray ray_to(const hierarchy::PlacedTree& body, const Vec3& start) {
  const Mat3 inverse_R = inverse(to_mat3(body.pose.R));
  const Vec3 t{body.pose.t[0], body.pose.t[1], body.pose.t[2]};
  const double unit = std::ldexp(1.0, -body.tree->unit_exponent());
  const double magnitude = sum(body.mesh->max_abs) + sum(abs(start)) + sum(abs(t));
  return {unit * (inverse_R * (start - t)),
          {inverse_R[0].x, inverse_R[1].x, inverse_R[2].x},
          unit * (0x1p-47 * magnitude) + 0x1p-100};
}

// A frame is exactly the numbers stored, and maps a ray to a ray. Off are, per coordinate and with c the node's radius
// and the start's 1-norm there: the slack, turned, by up to sqrt 3 of itself; the direction by 12 u of its length
// (adjugate and quotient) and 4 u for turning it, which at a distance of up to sqrt 3 c is less than 49 u c; the
// start's difference and turning, and differences with it, 9 u c; together less than 58 u c, of which 2^-46 c = 128 u c
// leaves room for the tests below, whose products and sums add less than 10 u c. Frames are orthonormal to 2^-20.
Ray in_frame(const Ray& ray, const Frame& frame) {
  const auto turned = [&](const Vec3& v) {
    const auto row = [&](int i) {
      return double{frame.axes[0][i]} * v.x + double{frame.axes[1][i]} * v.y + double{frame.axes[2][i]} * v.z;
    };
    return Vec3{row(0), row(1), row(2)};
  };
  const Vec3 start = turned(ray.start - Vec3{frame.origin[0], frame.origin[1], frame.origin[2]});
  return {start, turned(ray.direction), 1.74 * ray.slack + 0x1p-46 * (double{frame.radius} + sum(abs(start)))};
}

/// A bit for each child whose box the ray may meet. The line's separating axes are its cross products with the box's;
/// each adds up two coordinates that may be off by the slack, and the one along it three.
unsigned met(const Ray& ray, const WideNode& node) {
  const Vec3 d = ray.direction, a = abs(d), p = ray.start;
  const double slack = 2 * ray.slack;
  unsigned bits = 0;
  std::array<bool, hierarchy::kWidth> meets{};
  for (std::size_t lane = 0; lane < hierarchy::kWidth; ++lane) {
    const double x = node.center[0][lane] - p.x, y = node.center[1][lane] - p.y, z = node.center[2][lane] - p.z;
    const double hx = node.half[0][lane], hy = node.half[1][lane], hz = node.half[2][lane];
    const bool near_x = std::abs(y * d.z - z * d.y) <= hy * a.z + hz * a.y + slack;
    const bool near_y = std::abs(z * d.x - x * d.z) <= hz * a.x + hx * a.z + slack;
    const bool near_z = std::abs(x * d.y - y * d.x) <= hx * a.y + hy * a.x + slack;
    const bool ahead = x * d.x + y * d.y + z * d.z >= -(hx * a.x + hy * a.y + hz * a.z) - slack;
    meets[lane] = near_x & near_y & near_z & ahead;
  }
  for (std::uint32_t lane = 0; lane < node.size; ++lane) bits |= unsigned{meets[lane]} << lane;
  return bits;
}

void visit_leaf(const hierarchy::PlacedTree& body, const WideLeaf& leaf, const Visit& visit) {
  for (const std::uint32_t id : std::span(leaf.ids(), leaf.count)) {
    Triangle world;
    pose_vertices(body.pose, body.mesh->vertices, body.mesh->triangles[id], world.data());
    visit(world, id);
  }
}

void walk(const hierarchy::PlacedTree& body, const Ray& ray, const TreeRef& at, const Visit& visit) {
  if (at.is_leaf()) return visit_leaf(body, at.leaf(), visit);
  WideNode& node = at.node();
  hierarchy::MadeNodes nodes_made;
  const unsigned bits = met(in_frame(ray, node.frame), node);
  for (int lane = 0; lane < hierarchy::kWidth; ++lane)
    if ((bits >> lane & 1) != 0) walk(body, ray, body.tree->child(node, lane, nodes_made), visit);
}

}  // namespace

void walk_ray(const hierarchy::PlacedTree& body, const Vec3& start, const Visit& visit) {
  if (body.mesh->triangles.empty()) return;
  hierarchy::MadeNodes nodes_made;
  walk(body, ray_to(body, start), body.tree->root(nodes_made), visit);
}

}  // namespace impinge::solid
