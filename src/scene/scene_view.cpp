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

/// The exponent of a number's last place, of which it is a multiple; large for 0.
int last_place(double x) {
  const int biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7FF);
  return x == 0 ? 10000 : std::max(biased, 1) - 1075;
}

/// Whether a glance at the exponents shows that every world vertex is in the exact domain, as it nearly always does. No
/// entry of a valid R is above 1 + 1e-6, so no world coordinate is above 4 max|x| + |t|. Each product is a multiple of
/// its factors' last places, and so, for sums keep the lowest bit of their terms, is the coordinate.
bool is_clearly_in_domain(const Pose& pose, const MeshData& mesh) {
  double largest = 4 * max_component(mesh.max_abs);
  int lowest = 10000;
  for (const double r : pose.R) lowest = std::min(lowest, last_place(r) + mesh.min_bit);
  for (const double t : pose.t) largest = std::max(largest, std::abs(t)), lowest = std::min(lowest, last_place(t));
  return largest < 0x1p298 && lowest >= -358;
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

  // rounding_radius covers the world vertices' rounding and, with 12 u S to spare, that of the lines below.
  const Vec3 radius = rounding_radius(pose, mesh);
  const Mat3 R = to_mat3(pose.R);
  const Vec3 t{pose.t[0], pose.t[1], pose.t[2]};
  // |R d|² = dᵀ RᵀR d <= (1 + 3 max|RᵀR - I|) |d|², and sqrt(1 + x) <= 1 + x/2. Of a valid pose the defect is known
  // well enough; the bound was compared with a computed one.
  constexpr double stretch = 1 + 1.5 * kMostDefect + 0x1p-48;
  object.sphere = {R * mesh.sphere.center + t, stretch * mesh.sphere.radius + (radius.x + radius.y + radius.z)};

  const Vec3 middle = R * (0.5 * mesh.box.lo + 0.5 * mesh.box.hi) + t;
  const Vec3 half = 0.5 * mesh.box.hi - 0.5 * mesh.box.lo;
  const Vec3 reach = Vec3{dot(abs(R[0]), half), dot(abs(R[1]), half), dot(abs(R[2]), half)} + radius;
  const Vec3 r{object.sphere.radius, object.sphere.radius, object.sphere.radius};
  object.box = intersection({middle - reach, middle + reach}, {object.sphere.center - r, object.sphere.center + r});
  return object;
}

}  // namespace impinge::scene
