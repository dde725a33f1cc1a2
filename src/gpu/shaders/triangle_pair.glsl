// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Two triangles, with this device's roundings in single precision, u = 2^-23.
#ifndef TRIANGLE_PAIR_GLSL
#define TRIANGLE_PAIR_GLSL

#include "powers.glsl"

const uint kApart = 0, kCrossing = 1, kUnsure = 2;

// No determinant underflows by as much: of its terms, each of three factors that are at most a few times the leaves'
// extent, which is at most 1, fewer than 1000 may be taken for zero below 2^-126.
const float kTiny = kTwoToMinus100;

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

#define REAL float
#define REAL3 vec3
#define UNIT_ROUNDOFF kTwoToMinus23
#define UNDERFLOW kTiny
#include "triangle_pair_of.glsl"
#undef REAL
#undef REAL3
#undef UNIT_ROUNDOFF
#undef UNDERFLOW

#endif
