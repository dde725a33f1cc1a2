// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Two triangles: narrow/triangle_pair-inl.hpp, where the bounds are derived, for one pair of triangles. Included once a
// type, with REAL and REAL3, a roundoff that holds in every direction of rounding, and what no determinant underflows by.

REAL3 minus(REAL3 a, REAL3 b) {
  precise REAL x = a.x - b.x;
  precise REAL y = a.y - b.y;
  precise REAL z = a.z - b.z;
  return REAL3(x, y, z);
}
REAL3 perpendicular(REAL3 a, REAL3 b) {
  precise REAL x = a.y * b.z - a.z * b.y;
  precise REAL y = a.z * b.x - a.x * b.z;
  precise REAL z = a.x * b.y - a.y * b.x;
  return REAL3(x, y, z);
}
REAL along(REAL3 a, REAL3 b) {
  precise REAL sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}
REAL largest(REAL3 a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }

/// 1 and -1: certainly above and below zero; 0: unsure.
int sign_beyond(REAL x, REAL bound) { return int(x > bound) - int(x < -bound); }

uint test_pair(REAL3 a[3], REAL3 b[3], REAL error) {
  const REAL u = UNIT_ROUNDOFF;
  const REAL3 a1 = minus(a[1], a[0]), a2 = minus(a[2], a[0]), f1 = minus(b[1], b[0]), f2 = minus(b[2], b[0]),
             w = minus(b[0], a[0]);
  precise REAL La = max(largest(a1), largest(a2));
  precise REAL Lb = max(largest(f1), largest(f2));
  precise REAL S = (La + Lb) + largest(w);
  precise REAL h = 2.125 * error + 1.125 * u * S;
  La = La + h;
  Lb = Lb + h;
  S = 3.0 * h + S;
  precise REAL q = S * (24.5 * error + 49.0 * u * S);
  precise REAL bound_a = La * q + UNDERFLOW;
  precise REAL bound_b = Lb * q + UNDERFLOW;
  precise REAL bound_e = 2.0 * (La + Lb) * q + UNDERFLOW;

  // Sides of B's vertices of A's plane and the other way round.
  const REAL3 na = perpendicular(a1, a2), nb = perpendicular(f1, f2);
  precise REAL p1 = along(na, f1);
  precise REAL p2 = along(na, f2);
  precise REAL r1 = along(nb, a1);
  precise REAL r2 = along(nb, a2);
  precise REAL d0 = along(na, w);
  precise REAL e0 = -along(nb, w);
  precise REAL d1 = d0 + p1;
  precise REAL d2 = d0 + p2;
  precise REAL e1 = e0 + r1;
  precise REAL e2 = e0 + r2;
  const int of_b[3] = int[3](sign_beyond(d0, bound_a), sign_beyond(d1, bound_a), sign_beyond(d2, bound_a));
  const int of_a[3] = int[3](sign_beyond(e0, bound_b), sign_beyond(e1, bound_b), sign_beyond(e2, bound_b));
  if (on_one_side(of_a) || on_one_side(of_b)) return kApart;

  // Edges against edges, both triangles' in cyclic order: rows are A's edges 01, 12, 20, columns B's.
  const REAL3 g1 = perpendicular(f1, w), g2 = perpendicular(f2, w);
  precise REAL x11 = along(a1, g1);
  precise REAL x12 = along(a1, g2);
  precise REAL x21 = along(a2, g1);
  precise REAL x22 = along(a2, g2);
  precise REAL y1 = (x21 - x11) - p1;
  precise REAL y2 = (x22 - x12) - p2;
  precise REAL m01 = (x12 - x11) - r1;
  precise REAL m11 = (y2 - y1) - (r2 - r1);
  precise REAL m21 = (x21 - x22) + r2;
  int s[9];
  s[0] = sign_beyond(x11, bound_e);
  s[1] = sign_beyond(m01, bound_e);
  s[2] = sign_beyond(-x12, bound_e);
  s[3] = sign_beyond(y1, bound_e);
  s[4] = sign_beyond(m11, bound_e);
  s[5] = sign_beyond(-y2, bound_e);
  s[6] = sign_beyond(-x21, bound_e);
  s[7] = sign_beyond(m21, bound_e);
  s[8] = sign_beyond(x22, bound_e);

  Seen seen = Seen(true, false);
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    see_edge(of_a[i], of_a[j], s[3 * i], s[3 * i + 1], s[3 * i + 2], seen);
    see_edge(of_b[i], of_b[j], s[i], s[3 + i], s[6 + i], seen);
  }
  if (seen.all_miss) return kApart;
  const bool a_proper = of_b[0] != 0 || of_b[1] != 0 || of_b[2] != 0;
  const bool b_proper = of_a[0] != 0 || of_a[1] != 0 || of_a[2] != 0;
  return seen.some_pierces && a_proper && b_proper ? kCrossing : kUnsure;
}
