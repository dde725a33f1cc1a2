// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

// The paper's section 3.4: a place of the image is an edge, a quad over some of them is a triangle, the fragment is their
// test. Quads of several triangles may lie over each other. Fragments of what is certainly apart are discarded, so an
// occlusion query counts the others; where it counts none, all tests of the image are taken for apart. That each place
// of a quad gets its fragment follows from Vulkan's rules, for the quads' corners are borders of places to the bit
// (raster.vert), and is tried out before a device is used.

#include "edge_test.glsl"

layout(set = 0, binding = 0) uniform texture2D edges;
layout(set = 0, binding = 1, std430) readonly buffer Runs { RasterRun runs[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Verdicts { uint verdicts[]; };

layout(location = 0) flat in uint run_index;

// An edge's end, seen from the triangle's first corner. Scaling is by a power of two, which is exact but for underflow,
// by less than 2^-126.
vec3 seen_from_corner(vec3 end, RasterRun run) {
  precise float x = end.x * run.scale;
  precise float y = end.y * run.scale;
  precise float z = end.z * run.scale;
  return minus(vec3(x, y, z), vec3(run.corner[0], run.corner[1], run.corner[2]));
}

void main() {
  const ivec2 at = ivec2(gl_FragCoord.xy);
  const uint place = uint(at.y) * kRasterWidth + uint(at.x);
  const RasterRun run = runs[run_index];
  if (place < run.first || place - run.first >= run.count) discard;  // of a neighbour: never, by Vulkan's rules
  const vec4 from = texelFetch(edges, ivec2(2 * at.x, at.y), 0), to = texelFetch(edges, ivec2(2 * at.x + 1, at.y), 0);
  const vec3 p = seen_from_corner(from.xyz, run), q = seen_from_corner(to.xyz, run);
  // The ends' own errors, the corner's, and the difference's; an eighth more for the rounding of this sum and for
  // underflow, for run.error is at least 2^-120.
  precise float edge_error = 1.125 * (max(from.w, to.w) * run.scale + run.error +
                                      kTwoToMinus23 * max(largest(p), largest(q)));
  const uint verdict = test_edge(p, q, edge_error, vec3(run.a[0], run.a[1], run.a[2]),
                                 vec3(run.b[0], run.b[1], run.b[2]), run.error);
  verdicts[run.verdict + place - run.first] = verdict;
  if (verdict == kTestApart) discard;
}
