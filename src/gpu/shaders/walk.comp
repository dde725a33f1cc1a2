// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// A step of the walk down two trees (hierarchy/wide_walk.cpp): eight boxes against eight, one pair of boxes an
// invocation.

#include "frames.glsl"
#include "work.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = kNodesA, std430) readonly buffer NodesA { DeviceNode nodes_a[]; };
layout(set = 0, binding = kNodesB, std430) readonly buffer NodesB { DeviceNode nodes_b[]; };
layout(set = 0, binding = kLeavesA, std430) readonly buffer LeavesA { DeviceLeaf leaves_a[]; };
layout(set = 0, binding = kLeavesB, std430) readonly buffer LeavesB { DeviceLeaf leaves_b[]; };
layout(set = 0, binding = kRelations, std430) readonly buffer Relations { DeviceRelation relations[]; };
layout(set = 0, binding = kSettled, std430) readonly buffer Settled { uint settled[]; };
layout(set = 0, binding = kStack, std430) buffer Stack { WorkItem stack[]; };
layout(set = 0, binding = kLeafPairs, std430) writeonly buffer LeafPairs { WorkItem leaf_pairs[]; };

/// Boxes of both sides, and each as mapped to the other's frame; x, y, z of centres, then of half extents.
shared float own[kWalkedTogether][2][6][kDeviceWidth];
shared float mapped[kWalkedTogether][2][6][kDeviceWidth];
shared WorkItem items[kWalkedTogether];
shared uint sizes[kWalkedTogether];  // children of A and, from bit 8 on, of B; 0: nothing to do
shared FrameRelation relation[kWalkedTogether];
shared float slack[kWalkedTogether];
shared uint open_count, leaf_count, first_open, first_leaf, tests;

bool is_leaf(uint ref) { return (ref & kLeafBit) != 0; }
DeviceFrame frame_a(uint ref) {
  if (is_leaf(ref)) return leaves_a[ref & ~kLeafBit].frame;
  return nodes_a[ref].frame;
}
DeviceFrame frame_b(uint ref) {
  if (is_leaf(ref)) return leaves_b[ref & ~kLeafBit].frame;
  return nodes_b[ref].frame;
}

// The bound of hierarchy/wide_walk.cpp with this device's roundings, u = 2^-23: on the side of B's radius 16.5 * 2^-20
// for frames that are not quite orthonormal, 60 u for C, 17 u for the maps and tests; on that of A's and of c, 18 u for c
// and 17 u. Underflow adds less than 2^-120.
float slack_of(DeviceFrame a, DeviceFrame b, FrameRelation f, DeviceRelation trees) {
  precise float far = (abs(f.c[0]) + abs(f.c[1])) + abs(f.c[2]);
  precise float radius_b = b.radius * trees.scale;
  precise float slack = ((kTwoToMinus15 + 8.0 * trees.defect) * radius_b + kTwoToMinus17 * (a.radius + far)) +
                        (2.0 * trees.error + kTwoToMinus100);
  return slack;
}

void prepare(uint k, WorkItem item) {
  items[k] = item;
  sizes[k] = 0;
  if (config.first_only != 0 && settled[item.pair] != 0) return;
  DeviceFrame a = frame_a(item.a), b = frame_b(item.b);
  DeviceRelation trees = relations[item.pair];
  FrameRelation f = relate_frames(a, b, trees);
  relation[k] = f;
  slack[k] = slack_of(a, b, f, trees);
  uint size_a = is_leaf(item.a) ? 1 : nodes_a[item.a].size, size_b = is_leaf(item.b) ? 1 : nodes_b[item.b].size;
  sizes[k] = size_a | size_b << 8;
  atomicAdd(tests, size_a * size_b);
}

// Box `child` of side A (0) or B (1), also mapped to the other side's frame. A leaf is a node of one box.
void map_box(uint k, uint side, uint child) {
  if (child >= (sizes[k] >> 8 * side & 0xFF)) return;
  uint ref = side == 0 ? items[k].a : items[k].b;
  float scale = side == 0 ? 1.0 : relations[items[k].pair].scale;
  precise float center[3], extent[3];
  for (int i = 0; i < 3; ++i) {
    if (is_leaf(ref)) {
      center[i] = 0.0;
      extent[i] = side == 0 ? leaves_a[ref & ~kLeafBit].extent[i] : leaves_b[ref & ~kLeafBit].extent[i];
    } else {
      center[i] = side == 0 ? nodes_a[ref].center[8 * i + child] : nodes_b[ref].center[8 * i + child];
      extent[i] = side == 0 ? nodes_a[ref].extent[8 * i + child] : nodes_b[ref].extent[8 * i + child];
    }
    center[i] = scale * center[i];
    extent[i] = scale * extent[i];
    own[k][side][i][child] = center[i];
    own[k][side][3 + i][child] = extent[i];
  }
  for (int i = 0; i < 3; ++i) {
    precise float middle, reach;
    if (side == 0) {  // C^T (x - c)
      middle = (relation[k].C[i] * (center[0] - relation[k].c[0]) + relation[k].C[3 + i] * (center[1] - relation[k].c[1])) +
               relation[k].C[6 + i] * (center[2] - relation[k].c[2]);
      reach = ((abs(relation[k].C[i]) * extent[0] + abs(relation[k].C[3 + i]) * extent[1]) +
               abs(relation[k].C[6 + i]) * extent[2]) + slack[k];
    } else {  // C x + c
      middle = ((relation[k].C[3 * i] * center[0] + relation[k].C[3 * i + 1] * center[1]) +
                relation[k].C[3 * i + 2] * center[2]) + relation[k].c[i];
      reach = ((abs(relation[k].C[3 * i]) * extent[0] + abs(relation[k].C[3 * i + 1]) * extent[1]) +
               abs(relation[k].C[3 * i + 2]) * extent[2]) + slack[k];
    }
    mapped[k][side][i][child] = middle;
    mapped[k][side][3 + i][child] = reach;
  }
}

bool may_overlap(uint k, uint i, uint j) {
  for (int axis = 0; axis < 3; ++axis) {
    precise float in_a = abs(mapped[k][1][axis][j] - own[k][0][axis][i]);
    precise float reach_a = mapped[k][1][3 + axis][j] + own[k][0][3 + axis][i];
    precise float in_b = abs(own[k][1][axis][j] - mapped[k][0][axis][i]);
    precise float reach_b = own[k][1][3 + axis][j] + mapped[k][0][3 + axis][i];
    if (in_a > reach_a || in_b > reach_b) return false;
  }
  return true;
}

uint child_a(uint ref, uint i) { return is_leaf(ref) ? ref : nodes_a[ref].child[i]; }
uint child_b(uint ref, uint j) { return is_leaf(ref) ? ref : nodes_b[ref].child[j]; }

void main() {
  const uint lane = gl_LocalInvocationID.x, i = lane / kDeviceWidth, j = lane % kDeviceWidth;
  const uint stride = gl_NumWorkGroups.x * kWalkedTogether;
  for (uint begin = gl_WorkGroupID.x * kWalkedTogether; begin < control.steps[config.step].take; begin += stride) {
    if (lane == 0) {
      open_count = 0;
      leaf_count = 0;
      tests = 0;
    }
    barrier();
    if (lane < kWalkedTogether) {
      sizes[lane] = 0;
      if (begin + lane < control.steps[config.step].take)
        prepare(lane, stack[control.steps[config.step].first + begin + lane]);
    }
    barrier();
    for (uint box = lane; box < kWalkedTogether * 2 * kDeviceWidth; box += kGroupSize)
      map_box(box / (2 * kDeviceWidth), box / kDeviceWidth % 2, box % kDeviceWidth);
    barrier();
    uint found = 0, open = 0, leaves = 0;
    for (uint k = 0; k < kWalkedTogether; ++k) {
      if (i >= (sizes[k] & 0xFF) || j >= sizes[k] >> 8 || !may_overlap(k, i, j)) continue;
      found |= 1u << k;
      if (is_leaf(child_a(items[k].a, i)) && is_leaf(child_b(items[k].b, j))) ++leaves; else ++open;
    }
    uint to_open = atomicAdd(open_count, open), to_leaf = atomicAdd(leaf_count, leaves);
    barrier();
    if (lane == 0) {
      first_open = open_count > 0 ? atomicAdd(control.steps[config.step].stack_size, open_count) : 0;
      first_leaf = leaf_count > 0 ? atomicAdd(control.leaf_pairs, leaf_count) : 0;
      const uint before = atomicAdd(control.box_tests, tests);
      if (before + tests < before) atomicAdd(control.box_tests_high, 1);
    }
    barrier();
    to_open += first_open;
    to_leaf += first_leaf;
    for (uint k = 0; k < kWalkedTogether; ++k) {
      if ((found >> k & 1) == 0) continue;
      const WorkItem next = WorkItem(child_a(items[k].a, i), child_b(items[k].b, j), items[k].pair);
      if (is_leaf(next.a) && is_leaf(next.b)) {
        leaf_pairs[to_leaf++] = next;
      } else {
        stack[to_open++] = next;
      }
    }
    barrier();  // before shared memory is written again
  }
}
