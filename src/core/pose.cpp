// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/pose.hpp"

#include <limits>

#include "core/float_environment.hpp"
#include "core/number.hpp"

namespace impinge {
namespace {

constexpr double kDomainLimit = 0x1p300;
constexpr int kDomainBit = -358;

// Compiled with -ffp-contract=off, as the whole library is: each product and each sum is rounded once.
inline Vec3 posed(const Pose& p, const Vec3& v) {
  return {((p.R[0] * v.x + p.R[1] * v.y) + p.R[2] * v.z) + p.t[0],
          ((p.R[3] * v.x + p.R[4] * v.y) + p.R[5] * v.z) + p.t[1],
          ((p.R[6] * v.x + p.R[7] * v.y) + p.R[8] * v.z) + p.t[2]};
}

Vec3 world_extent(const Pose& pose, const MeshData& mesh) {
  const Mat3 R = to_mat3(pose.R);
  return {dot(abs(R[0]), mesh.max_abs) + std::abs(pose.t[0]), dot(abs(R[1]), mesh.max_abs) + std::abs(pose.t[1]),
          dot(abs(R[2]), mesh.max_abs) + std::abs(pose.t[2])};
}

/// Every world coordinate is a multiple of two to this power: sums keep the lowest bit of their terms, and rounding to
/// 53 bits only raises it, so a product r*x is a multiple of 2^(bit r + bit x) and of 2^(exponent r + exponent x - 52).
int lowest_world_bit(const Pose& pose, const MeshData& mesh) {
  int lowest = std::numeric_limits<int>::max();
  for (const double r : pose.R) {
    if (r == 0) continue;
    lowest = std::min(lowest, std::max(lowest_bit(r) + mesh.min_bit, exponent(r) + mesh.min_exponent - 52));
  }
  for (const double t : pose.t)
    if (t != 0) lowest = std::min(lowest, lowest_bit(t));
  return lowest;
}

/// Whether all that triangles use pass a test. `largest` bounds the world coordinates.
template <class Test>
bool all_vertices(const Pose& pose, const MeshData& mesh, double largest, const Test& test) {
  // Beyond this the bounds themselves would overflow, and a world coordinate in range could only be a cancelled 0.
  if (!(largest < 0x1p900)) return false;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle)
      if (!test(posed(pose, mesh.vertices[i]))) return false;
  return true;
}

bool in_exact_domain(double x) { return x == 0 || (std::abs(x) < kDomainLimit && lowest_bit(x) >= kDomainBit); }

}  // namespace

Point world_vertex(const Pose& pose, const Point& vertex) {
  const FloatEnvironment nearest;
  return posed(pose, vertex);
}

void pose_vertices(const Pose& pose, std::span<const Vec3> vertices, std::span<const std::uint32_t> indices,
                   Vec3* out) {
  for (const std::uint32_t i : indices) *out++ = posed(pose, vertices[i]);
}

void pose_all_vertices(const Pose& pose, std::span<Vec3> vertices) {
  for (Vec3& v : vertices) v = posed(pose, v);
}

double orthogonality_defect(const Pose& pose) {
  const Mat3 columns = transpose(to_mat3(pose.R));
  double defect = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) defect = std::max(defect, std::abs(dot(columns[i], columns[j]) - (i == j ? 1.0 : 0.0)));
  return defect;
}

Vec3 rounding_radius(const Pose& pose, const MeshData& mesh) {
  return 0x1p-49 * world_extent(pose, mesh) + Vec3{0x1p-1000, 0x1p-1000, 0x1p-1000};
}

bool in_exact_domain(const Pose& pose, const MeshData& mesh) {
  const double largest = max_component(world_extent(pose, mesh));
  if (largest < 0.999 * kDomainLimit && lowest_world_bit(pose, mesh) >= kDomainBit) return true;
  return all_vertices(pose, mesh, largest, [](const Vec3& v) { return in_exact_domain(v); });
}

bool in_range(const Pose& pose, const MeshData& mesh) {
  const double size = max_component(mesh.max_abs), largest = max_component(world_extent(pose, mesh));
  if (size > 0 && size < 0x1p-300) return false;
  return largest < 0.999 * kDomainLimit || all_vertices(pose, mesh, largest, [](const Vec3& v) { return in_range(v); });
}

bool in_range(const Vec3& point) { return max_component(abs(point)) < kDomainLimit && !std::isnan(sum(point)); }

bool in_exact_domain(const Vec3& point) {
  return in_exact_domain(point.x) && in_exact_domain(point.y) && in_exact_domain(point.z);
}

}  // namespace impinge
