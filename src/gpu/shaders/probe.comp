// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the device's arithmetic is like: one case an invocation, whole workgroups of them, judged by the host
// (gpu/probe.cpp).

#include "layout.h"
#include "triangle_pair.glsl"
#include "two_floats.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Cases { ProbeCase cases[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Answers { ProbeAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  const float a = cases[i].x[0], b = cases[i].x[1], c = cases[i].x[2], d = cases[i].x[3];
  precise float sum = a + b;
  precise float difference = a - b;
  precise float product = a * b;
  precise float unfused = a * b - c;
  const TwoFloats added = add(TwoFloats(a, 0.0), b);
  const TwoFloats multiplied = renormalised(add_product(TwoFloats(0.0, 0.0), TwoFloats(a, c), TwoFloats(b, d)));
  answers[i].x[0] = sum;
  answers[i].x[1] = difference;
  answers[i].x[2] = product;
  answers[i].x[3] = unfused;
  answers[i].x[4] = added.hi;
  answers[i].x[5] = added.lo;
  answers[i].x[6] = multiplied.hi;
  answers[i].x[7] = multiplied.lo;
  answers[i].x[8] = max(a, b);
  answers[i].x[9] = abs(a);
  answers[i].above = a > b ? 1 : 0;
  answers[i].sign = sign_beyond(a, abs(b));
}
