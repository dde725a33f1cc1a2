// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// Ends a step of the walk and plans the next. A step takes items from the top of the stack and puts their children above
// them; then the last of the children move to the places of those taken, so that the children of a step lie above all that
// is older: the walk goes on with them. Either there are as many children as places, or all of them move: no place is read
// and written.
//
// A step never takes more than whose children have room. While there is much room it takes all there is, and the walk is
// breadth first; as room runs out it takes less, at last one at a time, and the walk is depth first: then each step goes
// a level down and leaves at most 63 open beside the one it goes on with, so that the reserve of 64 a level is never used
// up, and the walk ends with a stack of any size.

#include "work.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = kStack, std430) buffer Stack { WorkItem stack[]; };

uint groups_for(uint items, uint at_once) { return min((items + at_once - 1) / at_once, config.most_groups); }

// By one invocation, while the others still read the step that ends.
void plan(uint size) {
  const uint next = 1 - config.step, children = kDeviceWidth * kDeviceWidth;
  const uint taken_up = min(size + config.stack_reserve, config.stack_capacity);
  const uint room = max((config.stack_capacity - taken_up) / (2 * children), 1);
  const uint leaf_room = (config.leaf_capacity - control.leaf_pairs) / children;
  const uint take = min(size, min(room, leaf_room));
  control.steps[next].stack_size = size;
  control.steps[next].take = take;
  control.steps[next].first = size - take;
  control.steps[next].walk_groups = uint[3](groups_for(take, kWalkedTogether), 1, 1);
  control.steps[next].plan_groups = uint[3](max(groups_for(take, kGroupSize), 1), 1, 1);
  control.steps[next].sweep_groups = uint[3](groups_for(control.leaf_pairs, kGroupSize), 1, 1);
}

void main() {
  const uint size = control.steps[config.step].stack_size, first = control.steps[config.step].first;
  const uint take = control.steps[config.step].take;
  const uint moved = min(size - (first + take), take), from = size - moved;
  for (uint i = gl_GlobalInvocationID.x; i < moved; i += gl_NumWorkGroups.x * kGroupSize)
    stack[first + i] = stack[from + i];
  if (gl_GlobalInvocationID.x == 0) plan(size - take);
}
