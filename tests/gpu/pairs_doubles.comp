// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// The filter of pairs of triangles in doubles by itself, for the attacks of arithmetic_test.cpp.

#define WITH_DOUBLES
#include "triangle_pair_doubles.glsl"

layout(local_size_x = 64) in;

struct StoredPair {
  double a[9], b[9];
  double error;
};
layout(set = 0, binding = 0, std430) readonly buffer Pairs { StoredPair pairs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Verdicts { uint verdicts[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= pairs.length()) return;
  dvec3 a[3], b[3];
  for (int v = 0; v < 3; ++v) {
    a[v] = dvec3(pairs[i].a[3 * v], pairs[i].a[3 * v + 1], pairs[i].a[3 * v + 2]);
    b[v] = dvec3(pairs[i].b[3 * v], pairs[i].b[3 * v + 1], pairs[i].b[3 * v + 2]);
  }
  verdicts[i] = test_pair(a, b, pairs[i].error);
}
