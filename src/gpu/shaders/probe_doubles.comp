// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the device's arithmetic is like in double precision: one case an invocation, whole workgroups of them.

#define WITH_DOUBLES
#include "layout.h"
#include "triangle_pair_doubles.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Cases { DoubleCase cases[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Answers { DoubleAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  const double a = cases[i].x[0], b = cases[i].x[1], c = cases[i].x[2];
  precise double sum = a + b;
  precise double difference = a - b;
  precise double product = a * b;
  precise double unfused = a * b - c;
  precise double taken = sum - a;
  precise double rest = b - taken;
  answers[i].x[0] = sum;
  answers[i].x[1] = difference;
  answers[i].x[2] = product;
  answers[i].x[3] = unfused;
  answers[i].x[4] = rest;
  answers[i].x[5] = max(a, b);
  answers[i].x[6] = abs(a);
  answers[i].above = a > b ? 1 : 0;
  answers[i].sign = sign_beyond(a, abs(b));
}
