// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the device's arithmetic is like: one case an invocation, whole workgroups of them.

#include "probe.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Cases { ProbeCase cases[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Answers { ProbeAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  answers[i] = answer_of(cases[i]);
}
