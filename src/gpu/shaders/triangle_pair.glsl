// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Two triangles: narrow/triangle_pair-inl.hpp, where the bounds are derived, for one pair and with this device's
// roundings, u = 2^-23.
#ifndef TRIANGLE_PAIR_GLSL
#define TRIANGLE_PAIR_GLSL

#include "powers.glsl"

const uint kApart = 0, kCrossing = 1, kUnsure = 2;

// No determinant underflows by as much: of its terms, each of three factors that are at most a few times the leaves'
// extent, which is at most 1, fewer than 1000 may be taken for zero below 2^-126.
const float kTiny = kTwoToMinus100;

vec3 minus(vec3 a, vec3 b) {
  precise float x = a.x - b.x;
  precise float y = a.y - b.y;
  precise float z = a.z - b.z;
  return vec3(x, y, z);
}
vec3 perpendicular(vec3 a, vec3 b) {
  precise float x = a.y * b.z - a.z * b.y;
  precise float y = a.z * b.x - a.x * b.z;
  precise float z = a.x * b.y - a.y * b.x;
  return vec3(x, y, z);
}
float along(vec3 a, vec3 b) {
  precise float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}
float largest(vec3 a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }

/// 1 and -1: certainly above and below zero; 0: unsure.
int sign_beyond(float x, float bound) { return int(x > bound) - int(x < -bound); }

/// What an edge says of the pair: the sides of its ends of the other's plane, and of the other's three edges of its line.
struct Seen {
  bool all_miss, some_pierces;
};
void see_edge(int from, int to, int s0, int s1, int s2, inout Seen seen) {
  const bool above = s0 > 0 || s1 > 0 || s2 > 0, below = s0 < 0 || s1 < 0 || s2 < 0;
  const bool all_same = (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
  seen.all_miss = seen.all_miss && (from * to > 0 || (above && below));
  seen.some_pierces = seen.some_pierces || (from * to < 0 && all_same);
}

bool on_one_side(int s[3]) { return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0); }

uint test_pair(vec3 a[3], vec3 b[3], float error) {
  const float u = kTwoToMinus23;
  const vec3 a1 = minus(a[1], a[0]), a2 = minus(a[2], a[0]), f1 = minus(b[1], b[0]), f2 = minus(b[2], b[0]),
             w = minus(b[0], a[0]);
  precise float La = max(largest(a1), largest(a2));
  precise float Lb = max(largest(f1), largest(f2));
  precise float S = (La + Lb) + largest(w);
  precise float h = 2.125 * error + 1.125 * u * S;
  La = La + h;
  Lb = Lb + h;
  S = 3.0 * h + S;
  precise float q = S * (24.5 * error + 49.0 * u * S);
  precise float bound_a = La * q + kTiny;
  precise float bound_b = Lb * q + kTiny;
  precise float bound_e = 2.0 * (La + Lb) * q + kTiny;

  // Sides of B's vertices of A's plane and the other way round.
  const vec3 na = perpendicular(a1, a2), nb = perpendicular(f1, f2);
  precise float p1 = along(na, f1);
  precise float p2 = along(na, f2);
  precise float r1 = along(nb, a1);
  precise float r2 = along(nb, a2);
  precise float d0 = along(na, w);
  precise float e0 = -along(nb, w);
  precise float d1 = d0 + p1;
  precise float d2 = d0 + p2;
  precise float e1 = e0 + r1;
  precise float e2 = e0 + r2;
  const int of_b[3] = int[3](sign_beyond(d0, bound_a), sign_beyond(d1, bound_a), sign_beyond(d2, bound_a));
  const int of_a[3] = int[3](sign_beyond(e0, bound_b), sign_beyond(e1, bound_b), sign_beyond(e2, bound_b));
  if (on_one_side(of_a) || on_one_side(of_b)) return kApart;

  // Edges against edges, both triangles' in cyclic order: rows are A's edges 01, 12, 20, columns B's.
  const vec3 g1 = perpendicular(f1, w), g2 = perpendicular(f2, w);
  precise float x11 = along(a1, g1);
  precise float x12 = along(a1, g2);
  precise float x21 = along(a2, g1);
  precise float x22 = along(a2, g2);
  precise float y1 = (x21 - x11) - p1;
  precise float y2 = (x22 - x12) - p2;
  precise float m01 = (x12 - x11) - r1;
  precise float m11 = (y2 - y1) - (r2 - r1);
  precise float m21 = (x21 - x22) + r2;
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

#endif
