// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// The relation of two frames by itself, for relation_test.cpp.

#include "frames.glsl"

layout(local_size_x = 64) in;

struct FrameCase {
  DeviceFrame a, b;
  DeviceRelation trees;
};
layout(set = 0, binding = 0, std430) readonly buffer Cases { FrameCase cases[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Found { float found[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  const DeviceFrame a = cases[i].a, b = cases[i].b;
  const DeviceRelation trees = cases[i].trees;
  const FrameRelation f = relate_frames(a, b, trees);
  for (uint k = 0; k < 9; ++k) found[12 * i + k] = f.C[k];
  for (uint k = 0; k < 3; ++k) found[12 * i + 9 + k] = f.c[k];
}
