// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Two triangles in double precision, u = 2^-52, of coordinates up to 1.01 and an error of at least 2^-49: then every
// bound is above 2^-140, and what underflows, 2^-1022 a term, is less than what its factors are rounded up by.
#ifndef TRIANGLE_PAIR_DOUBLES_GLSL
#define TRIANGLE_PAIR_DOUBLES_GLSL

#include "layout.h"
#include "triangle_pair.glsl"

const double kTwoToMinus49 = 1.7763568394002504646778106689453125e-15LF;
const double kTwoToMinus52 = 2.220446049250313080847263336181640625e-16LF;

#define REAL double
#define REAL3 dvec3
#define UNIT_ROUNDOFF kTwoToMinus52
#define UNDERFLOW 0.0LF
#include "triangle_pair_of.glsl"
#undef REAL
#undef REAL3
#undef UNIT_ROUNDOFF
#undef UNDERFLOW

// A vertex in the world, which is scaled to at most 1: within 2^-49 of contract 1.1's number (gpu/relation.cpp).
dvec3 posed(DevicePose pose, dvec3 v) {
  precise double x = ((pose.R[0] * v.x + pose.R[1] * v.y) + pose.R[2] * v.z) + pose.t[0];
  precise double y = ((pose.R[3] * v.x + pose.R[4] * v.y) + pose.R[5] * v.z) + pose.t[1];
  precise double z = ((pose.R[6] * v.x + pose.R[7] * v.y) + pose.R[8] * v.z) + pose.t[2];
  return dvec3(x, y, z);
}

#endif
