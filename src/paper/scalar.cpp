// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/scalar.hpp"

#include "exact/filter.hpp"

namespace impinge::paper {
namespace {

/// The certain side of a plane, or of a line through its normal's triangle, that a third difference is on; 0 is unsure.
int side(const exact::FilteredNormal& plane, const Vec3& difference) {
  const int sign = plane.sign(difference);
  return sign == exact::kUnsure ? 0 : sign;
}

/// Section 3.4 (1). `plane` is the triangle's.
Verdict test_edge(const Vec3& from, const Vec3& to, const Triangle& t, const exact::FilteredNormal& plane) {
  const int side_from = side(plane, from - t[0]), side_to = side(plane, to - t[0]);
  if (side_from * side_to > 0) return Verdict::no;

  // The line through the edge passes the triangle's edges on these sides. Two that differ put it outside, whatever the
  // plane's sides are: the line's point in the plane has barycentric coordinates of both signs, a line parallel to the
  // plane meets nothing, and one within the plane has no certain side.
  const Vec3 direction = to - from;
  const Vec3 u0 = t[0] - from, u1 = t[1] - from, u2 = t[2] - from;
  const int s0 = side({u0, u1}, direction);
  const int s1 = side({u1, u2}, direction);
  if (s0 * s1 < 0) return Verdict::no;
  const int s2 = side({u2, u0}, direction);
  if (s0 * s2 < 0 || s1 * s2 < 0) return Verdict::no;
  return side_from * side_to < 0 && s0 * s1 * s2 != 0 ? Verdict::crossing : Verdict::unsure;
}

}  // namespace

void test_edges(const Batch& batch, std::vector<Verdict>& verdicts) {
  verdicts.clear();
  for (std::size_t i = 0; i < batch.tests.size();) {
    const std::uint32_t triangle = batch.tests[i].triangle;
    const Triangle t = batch.triangle(triangle);
    const exact::FilteredNormal plane(t[1] - t[0], t[2] - t[0]);
    for (; i < batch.tests.size() && batch.tests[i].triangle == triangle; ++i) {
      const auto& edge = batch.edges[batch.tests[i].edge];
      verdicts.push_back(test_edge(batch.vertices[edge[0]], batch.vertices[edge[1]], t, plane));
    }
  }
}

}  // namespace impinge::paper
