// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/scene_view.hpp"

#include <algorithm>
#include <bit>

#include "core/hash.hpp"
#include "core/pose.hpp"
#include "scene/validate_pose.hpp"

namespace impinge::scene {
namespace {

Vec3 to_vec3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The least of some numbers that are not 0, by their magnitudes' bits less 1: what 0 has becomes the largest.
std::uint64_t least_bits(std::span<const double> numbers) {
  std::uint64_t least = ~std::uint64_t{0};
  for (const double x : numbers)
    least = std::min(least, (std::bit_cast<std::uint64_t>(x) & ~std::uint64_t{0} >> 1) - 1);
  return least;
}

/// The exponent of the last place of the least number, of which all are multiples, or one less; large if all are 0.
int last_place(std::uint64_t least) { return std::max(static_cast<int>(least >> 52), 1) - 1075; }

/// Whether a glance at the exponents shows that every world vertex is in the exact domain, as it nearly always does. No
/// entry of a valid R is above 1 + 1e-6, so no world coordinate is above 4 max|x| + |t|. Each product is a multiple of
/// its factors' last places, and so, for sums keep the lowest bit of their terms, is the coordinate. The smaller a
/// number, the lower its last place: the smallest alone is looked at.
bool is_clearly_in_domain(const Pose& pose, const MeshData& mesh) {
  const double largest = std::max(4 * max_component(mesh.max_abs), max_component(abs(to_vec3(pose.t))));
  return largest < 0x1p298 && last_place(least_bits(pose.R)) + mesh.min_bit >= -358 &&
         last_place(least_bits(pose.t)) >= -358;
}

}  // namespace

std::uint64_t key(const MeshData& mesh, const Pose& pose) {
  std::uint64_t key = mesh.hash;
  for (const double r : pose.R) key = mix(key, number_bits(r));
  for (const double t : pose.t) key = mix(key, number_bits(t));
  return key;
}

PlacedObject place(const MeshData& mesh, const Pose& pose, std::uint32_t group) {
  PlacedObject object;
  object.pose = pose;
  object.group = group;
  if (mesh.triangles.empty()) return object;
  object.mesh = &mesh;
  object.is_fine = !is_clearly_in_domain(pose, mesh) && !in_exact_domain(pose, mesh);
  object.in_domain = !object.is_fine || in_range(pose, mesh);
  if (!object.in_domain) return object;  // queries refuse it, and its bounds might not be numbers

  // At least `rounding_radius` in every axis, as no |r| is above 1.001; it covers the world vertices' rounding and,
  // with 12 u S to spare, that of the lines below.
  const double rounding = 0x1p-49 * (1.001 * sum(mesh.max_abs) + max_component(abs(to_vec3(pose.t)))) + 0x1p-1000;
  // |R d|² = dᵀ RᵀR d <= (1 + 3 max|RᵀR - I|) |d|², sqrt(1 + x) <= 1 + x/2, and of a valid pose the defect is known.
  constexpr double kStretch = 1 + 1.6 * kMostDefect;
  const double radius = kStretch * mesh.sphere.radius + 3 * rounding;
  // By columns of four, which compilers work on two at a time.
  const auto& R = pose.R;
  alignas(16) const double x[4] = {R[0], R[3], R[6], 0}, y[4] = {R[1], R[4], R[7], 0}, z[4] = {R[2], R[5], R[8], 0},
                           t[4] = {pose.t[0], pose.t[1], pose.t[2], 0};
  const Vec3& c = mesh.sphere.center;
  const Vec3 m = 0.5 * mesh.box.lo + 0.5 * mesh.box.hi, half = 0.5 * mesh.box.hi - 0.5 * mesh.box.lo;
  alignas(16) double center[4], lo[4], hi[4];
  for (int i = 0; i < 4; ++i) {
    center[i] = x[i] * c.x + y[i] * c.y + z[i] * c.z + t[i];
    const double middle = x[i] * m.x + y[i] * m.y + z[i] * m.z + t[i];
    const double reach = std::abs(x[i]) * half.x + std::abs(y[i]) * half.y + std::abs(z[i]) * half.z + rounding;
    lo[i] = std::max(middle - reach, center[i] - radius), hi[i] = std::min(middle + reach, center[i] + radius);
  }
  object.sphere = {{center[0], center[1], center[2]}, radius};
  object.box = {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
  return object;
}

}  // namespace impinge::scene
