// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/obb.hpp"

#include <Eigen/Eigenvalues>

#include "core/number.hpp"

namespace impinge::paper {
namespace {

template <class Visit>
void for_each_vertex(const MeshData& mesh, std::span<const std::uint32_t> triangles, const Visit& visit) {
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles[t]) visit(mesh.vertices[v]);
}

/// Equation 2, about the first vertex so that a mesh far from its origin loses nothing.
Vec3 mean_vertex(const MeshData& mesh, std::span<const std::uint32_t> triangles) {
  const Vec3 first = mesh.vertices[mesh.triangles[triangles[0]][0]];
  Vec3 sum{0, 0, 0};
  for_each_vertex(mesh, triangles, [&](const Vec3& v) { sum = sum + (v - first); });
  return first + 1.0 / (3.0 * static_cast<double>(triangles.size())) * sum;
}

/// Equation 3 without its factor 1/3n, which turns no eigenvector, in units that keep the squares within range.
Eigen::Matrix3d covariance(const MeshData& mesh, std::span<const std::uint32_t> triangles, const Vec3& mean) {
  const double extent = max_component(mesh.box.hi - mesh.box.lo);
  const double unit = extent > 0 ? std::ldexp(1.0, -exponent(extent)) : 1.0;
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for_each_vertex(mesh, triangles, [&](const Vec3& v) {
    const Vec3 d = unit * (v - mean);
    xx += d.x * d.x, yy += d.y * d.y, zz += d.z * d.z;
    xy += d.x * d.y, yz += d.y * d.z, zx += d.z * d.x;
  });
  Eigen::Matrix3d c;
  c << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  return c;
}

/// Orthonormal to rounding whatever the eigensolver returned: any axes make a true box, good ones a tight box.
Mat3 orthonormal_axes(const Eigen::Matrix3d& c) {
  const Mat3 identity = Obb{}.axes;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(c);
  const auto column = [&](Eigen::Index i) {
    return Vec3{solver.eigenvectors()(0, i), solver.eigenvectors()(1, i), solver.eigenvectors()(2, i)};
  };
  // Twice is enough for Gram-Schmidt to reach rounding, as long as the remainder is not lost in it.
  const auto normalized = [](const Vec3& v) { return (1.0 / norm(v)) * v; };
  const Vec3 first = normalized(normalized(column(2)));
  Vec3 second = column(1) - dot(column(1), first) * first;
  if (!(norm(second) > 1e-3)) return identity;
  second = normalized(second);
  second = normalized(second - dot(second, first) * first);
  const Vec3 third = cross(first, second);
  return std::isfinite(third.x + third.y + third.z) ? Mat3{first, second, third} : identity;
}

}  // namespace

Obb fit_obb(const MeshData& mesh, std::span<const std::uint32_t> triangles) {
  const Vec3 mean = mean_vertex(mesh, triangles);
  Obb box;
  box.axes = orthonormal_axes(covariance(mesh, triangles, mean));

  // Equation 4.
  Vec3 hi{-kInfinity, -kInfinity, -kInfinity}, lo{kInfinity, kInfinity, kInfinity};
  for_each_vertex(mesh, triangles, [&](const Vec3& v) {
    const Vec3 projected = box.axes * (v - mean);
    hi = max(hi, projected), lo = min(lo, projected);
  });

  // Equation 5. The projections are off by less than 8 eps of a vertex's distance from the mean, axes that are
  // orthonormal only to 24 eps add that much, and the centre is rounded relative to the mesh's coordinates: 64 eps and
  // 8 eps cover it.
  const Vec3 middle = 0.5 * (hi + lo);
  box.center = mean + transpose(box.axes) * middle;
  const Vec3 extent = max(abs(hi), abs(lo));
  const double slack =
      0x1p-47 * (extent.x + extent.y + extent.z) + 0x1p-50 * (mesh.max_abs.x + mesh.max_abs.y + mesh.max_abs.z);
  box.half = 0.5 * (hi - lo) + Vec3{slack, slack, slack};
  return box;
}

}  // namespace impinge::paper
