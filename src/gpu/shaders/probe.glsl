// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// A trial of the device's arithmetic, judged by the host (gpu/probe.cpp).
#ifndef PROBE_GLSL
#define PROBE_GLSL

#include "layout.h"
#include "triangle_pair.glsl"
#include "two_floats.glsl"

ProbeAnswer answer_of(ProbeCase of) {
  const float a = of.x[0], b = of.x[1], c = of.x[2], d = of.x[3];
  precise float sum = a + b;
  precise float difference = a - b;
  precise float product = a * b;
  precise float unfused = a * b - c;
  const TwoFloats added = add(TwoFloats(a, 0.0), b);
  const TwoFloats multiplied = renormalised(add_product(TwoFloats(0.0, 0.0), TwoFloats(a, c), TwoFloats(b, d)));
  ProbeAnswer answer;
  answer.x[0] = sum;
  answer.x[1] = difference;
  answer.x[2] = product;
  answer.x[3] = unfused;
  answer.x[4] = added.hi;
  answer.x[5] = added.lo;
  answer.x[6] = multiplied.hi;
  answer.x[7] = multiplied.lo;
  answer.x[8] = max(a, b);
  answer.x[9] = abs(a);
  answer.above = a > b ? 1 : 0;
  answer.sign = sign_beyond(a, abs(b));
  return answer;
}

#endif
