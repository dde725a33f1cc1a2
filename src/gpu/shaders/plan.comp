// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the next step of the walk takes, for one invocation. A step takes items from the top of the stack and puts their
// children above them; then the last of the children fill the places of those taken (fill.comp), so that the children of
// a step lie above all that is older: the walk goes on with them.
//
// A step never takes more than whose children have room. While there is much room it takes all there is, and the walk is
// breadth first; as room runs out it takes less, at last one at a time, and the walk is depth first: then each step goes
// a level down and leaves at most 63 open beside the one it goes on with, so that the reserve of 64 a level is never used
// up, and the walk ends with a stack of any size.

#include "work.glsl"

layout(local_size_x = 1) in;

uint groups_for(uint items, uint at_once) { return min((items + at_once - 1) / at_once, config.most_groups); }

void main() {
  control.stack_size -= control.take;  // those of the last step
  control.take = 0;
  control.sweep_groups = uint[3](groups_for(control.leaf_pairs, kGroupSize), 1, 1);
  if (config.only_sweep != 0) return;
  const uint size = control.stack_size, children = kDeviceWidth * kDeviceWidth;
  const uint taken_up = min(size + config.stack_reserve, config.stack_capacity);
  const uint room = max((config.stack_capacity - taken_up) / (2 * children), 1);
  const uint leaf_room = (config.leaf_capacity - control.leaf_pairs) / children;
  control.take = min(size, min(room, leaf_room));
  control.first = size - control.take;
  control.walk_groups = uint[3](groups_for(control.take, kWalkedTogether), 1, 1);
  control.fill_groups = uint[3](groups_for(control.take, kGroupSize), 1, 1);
}
