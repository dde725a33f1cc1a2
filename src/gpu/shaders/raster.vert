// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// A run as a quad over its texels. Its corners lie on the texels' borders, to the bit: the image's sides are powers of
// two, so every number here is a multiple of 2^-10 that is at most 2, or a whole number.

#include "layout.h"

layout(set = 0, binding = 1, std430) readonly buffer Runs { RasterRun runs[]; };

layout(location = 0) flat out uint run_index;

void main() {
  const uint first = runs[gl_InstanceIndex].first, count = runs[gl_InstanceIndex].count;
  const uint x = first % kRasterWidth + (gl_VertexIndex & 1) * count;
  const uint y = first / kRasterWidth + (gl_VertexIndex >> 1);
  gl_Position = vec4(float(x) * (2.0 / float(kRasterWidth)) - 1.0, float(y) * (2.0 / float(kRasterHeight)) - 1.0, 0.0,
                     1.0);
  run_index = uint(gl_InstanceIndex);
}
