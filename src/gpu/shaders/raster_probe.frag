// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the arithmetic of fragments is like: one case a texel.

#include "probe.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Cases { ProbeCase cases[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Answers { ProbeAnswer answers[]; };

void main() {
  const uint i = uint(gl_FragCoord.y) * kRasterWidth + uint(gl_FragCoord.x);
  if (i >= cases.length()) discard;
  answers[i] = answer_of(cases[i]);
}
