// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// An edge and a triangle: paper/scalar.cpp in single precision.
#ifndef EDGE_TEST_GLSL
#define EDGE_TEST_GLSL

#include "layout.h"
#include "triangle_pair.glsl"

// From p to q, against the triangle of the origin, a and b, each coordinate at most 1, those of p and q within
// `edge_error` of the exact ones, those of a and b within `triangle_error`; the errors are at least 2^-120.
//
// With u = 2^-23 a sum, difference or product is off by less than u of itself, whichever way it was rounded, or by less
// than 2^-126 where it was taken for zero. For vectors whose largest coordinates are at most P, Q and R and off by at
// most e_p, e_q and e_r (P, Q and R taken larger by that), det(p, q, r) is off
//   by at most 6 (e_p QR + e_q PR + e_r PQ) from its inputs, for it has six terms;
//   by at most 29 u PQR from its arithmetic: see narrow/triangle_pair-inl.hpp.
// Sides of the plane, det(a, b, p), with A of a and b, and E of p and q:
//   A (6 (2 triangle_error E + edge_error A) + 29 u A E).
// Sides of the triangle's edges, det(v, w, q - p), v from p to a corner, w along the edge from there (which is what the
// plain form's det is with the next corner, and keeps its digits where the triangle is small beside the edge), with V of
// v, W of w and D of q - p:
//   6 (e_v W D + e_w V D + e_d V W) + 29 u V W D,
//   e_v = triangle_error + edge_error + u V, e_w = 2 triangle_error + u W, e_d = 2 edge_error + u D.
// The factors are rounded up by enough for the arithmetic of the bounds: by a sixtieth at least where some ten roundings
// of u matter, to 6.1 and 30, and by an eighth in e_v, e_w and e_d, which also makes up for differences taken for zero.
// Whatever else underflows is less than kTiny, for a coordinate is at most 2 and a determinant has six terms.
uint test_edge(vec3 p, vec3 q, float edge_error, vec3 a, vec3 b, float triangle_error) {
  const float u = kTwoToMinus23;
  precise float A = max(largest(a), largest(b)) + triangle_error;
  precise float E = max(largest(p), largest(q)) + edge_error;
  precise float plane_bound = A * (6.1 * (2.0 * triangle_error * E + edge_error * A) + 30.0 * u * A * E) + kTiny;
  const vec3 plane = perpendicular(a, b);
  const int from = sign_beyond(along(plane, p), plane_bound);
  const int to = sign_beyond(along(plane, q), plane_bound);
  if (from * to > 0) return kTestApart;

  const vec3 v0 = -p, v1 = minus(a, p), v2 = minus(b, p), w = minus(b, a), d = minus(q, p);
  precise float V = max(largest(v0), max(largest(v1), largest(v2)));
  precise float W = max(largest(w), max(largest(a), largest(b)));
  precise float D = largest(d);
  precise float e_v = 1.125 * (triangle_error + edge_error) + 1.125 * u * V;
  precise float e_w = 2.25 * triangle_error + 1.125 * u * W;
  precise float e_d = 2.25 * edge_error + 1.125 * u * D;
  V = V + e_v;
  W = W + e_w;
  D = D + e_d;
  precise float bound = 6.1 * (e_v * W * D + e_w * V * D + e_d * V * W) + 30.0 * u * V * W * D + kTiny;
  const int s0 = sign_beyond(along(perpendicular(v0, a), d), bound);
  const int s1 = sign_beyond(along(perpendicular(v1, w), d), bound);
  const int s2 = sign_beyond(along(perpendicular(v2, -b), d), bound);
  if (s0 * s1 < 0 || s0 * s2 < 0 || s1 * s2 < 0) return kTestApart;
  return from * to < 0 && s0 * s1 * s2 != 0 ? kTestCrossing : kTestUnsure;
}

#endif
