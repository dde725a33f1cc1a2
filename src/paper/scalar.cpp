// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/scalar.hpp"

#include "core/vec3.hpp"

namespace impinge::paper {
namespace {

// det(a, b, c) of rounded differences is off by at most (7 + 56 eps) eps times the sum of the absolute products, eps =
// 2^-53 (Shewchuk 1997); 8 eps leaves room for the rounding of the bound. Underflow: see exact/filter.hpp.
constexpr double kBound = 0x1p-50, kUnderflow = 0x1p-760;

/// A cross product and the sums of the absolute values of its terms.
struct CertifiedNormal {
  Vec3 n, magnitude;
  CertifiedNormal(const Vec3& a, const Vec3& b) {
    const double yz = a.y * b.z, zy = a.z * b.y, zx = a.z * b.x, xz = a.x * b.z, xy = a.x * b.y, yx = a.y * b.x;
    n = {yz - zy, zx - xz, xy - yx};
    magnitude = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }
  /// The certain sign of the determinant with a third vector; 0 is "unsure".
  [[nodiscard]] int side(const Vec3& c) const {
    const double determinant = c.x * n.x + c.y * n.y + c.z * n.z;
    const double bound =
        kBound * (std::abs(c.x) * magnitude.x + std::abs(c.y) * magnitude.y + std::abs(c.z) * magnitude.z) + kUnderflow;
    return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
  }
};

/// Section 3.4 (1). `plane` is the triangle's.
Verdict test_edge(const Vec3& from, const Vec3& to, const Triangle& t, const CertifiedNormal& plane) {
  const int side_from = plane.side(from - t[0]), side_to = plane.side(to - t[0]);
  if (side_from * side_to > 0) return Verdict::no;

  // The line through the edge passes the triangle's edges on these sides. Two that differ put it outside, whatever the
  // plane's sides are: the line's point in the plane has barycentric coordinates of both signs, a line parallel to the
  // plane meets nothing, and one within the plane has no certain side.
  const Vec3 direction = to - from;
  const Vec3 u0 = t[0] - from, u1 = t[1] - from, u2 = t[2] - from;
  const int s0 = CertifiedNormal(u0, u1).side(direction);
  const int s1 = CertifiedNormal(u1, u2).side(direction);
  if (s0 * s1 < 0) return Verdict::no;
  const int s2 = CertifiedNormal(u2, u0).side(direction);
  if (s0 * s2 < 0 || s1 * s2 < 0) return Verdict::no;
  return side_from * side_to < 0 && s0 * s1 * s2 != 0 ? Verdict::crossing : Verdict::unsure;
}

}  // namespace

void test_edges(const Batch& batch, std::vector<Verdict>& verdicts) {
  verdicts.clear();
  for (std::size_t i = 0; i < batch.tests.size();) {
    const std::uint32_t triangle = batch.tests[i].triangle;
    const Triangle t = batch.triangle(triangle);
    const CertifiedNormal plane(t[1] - t[0], t[2] - t[0]);
    for (; i < batch.tests.size() && batch.tests[i].triangle == triangle; ++i) {
      const auto& edge = batch.edges[batch.tests[i].edge];
      verdicts.push_back(test_edge(batch.vertices[edge[0]], batch.vertices[edge[1]], t, plane));
    }
  }
}

}  // namespace impinge::paper
