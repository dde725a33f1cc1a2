// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// After a step of the walk: the last of the children move to the places of the items that were taken (plan.comp). Either
// there are as many children as places, or all of them move: no place is read and written.

#include "work.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = kStack, std430) buffer Stack { WorkItem stack[]; };

void main() {
  const uint moved = min(control.stack_size - (control.first + control.take), control.take);
  const uint from = control.stack_size - moved;
  for (uint i = gl_GlobalInvocationID.x; i < moved; i += gl_NumWorkGroups.x * kGroupSize)
    stack[control.first + i] = stack[from + i];
}
