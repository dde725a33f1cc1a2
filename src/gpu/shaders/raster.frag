// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

// The paper's section 3.4: a texel holds an edge, the quad over it is a triangle, the fragment is their test. A texel
// that no quad covers keeps the verdict it had before: unsure. Fragments of what is certainly apart are discarded, so an
// occlusion query counts the others.

#include "edge_test.glsl"

layout(set = 0, binding = 0) uniform texture2D edges;
layout(set = 0, binding = 1, std430) readonly buffer Runs { RasterRun runs[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Verdicts { uint verdicts[]; };

layout(location = 0) flat in uint run_index;

void main() {
  const ivec2 at = ivec2(gl_FragCoord.xy);
  const uint place = uint(at.y) * kRasterWidth + uint(at.x);
  const RasterRun run = runs[run_index];
  if (place < run.first || place - run.first >= run.count) discard;  // of a neighbour: never, by Vulkan's rules
  const vec4 from = texelFetch(edges, ivec2(2 * at.x, at.y), 0), to = texelFetch(edges, ivec2(2 * at.x + 1, at.y), 0);
  const uint verdict = test_edge(from.xyz, to.xyz, max(from.w, to.w), vec3(run.a[0], run.a[1], run.a[2]),
                                 vec3(run.b[0], run.b[1], run.b[2]), run.error);
  verdicts[place] = verdict;
  if (verdict == kTestApart) discard;
}
