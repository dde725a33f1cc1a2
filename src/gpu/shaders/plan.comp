// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// What the next step of the walk takes, for one invocation. Two stacks take turns: what is taken from the top of one
// has its children put on the other, so that nothing is overwritten that is still to be read; the one written to last is
// taken from next.
//
// A step never takes more than whose children have room. While there is much room it takes all there is, and the walk is
// breadth first; as room runs out it takes less, at last one at a time, and the walk is depth first. One at a time, each
// step adds 63 at most and goes a level down, so that the reserve of 64 a level is never used up: the walk always ends.

#include "work.glsl"

layout(local_size_x = 1) in;

void plan_sweep() {
  control.sweep_groups[0] = min((control.leaf_pairs + kGroupSize - 1) / kGroupSize, config.most_groups);
  control.sweep_groups[1] = 1;
  control.sweep_groups[2] = 1;
}

void main() {
  if (config.only_sweep != 0) {
    plan_sweep();
    return;
  }
  uint source = control.stack_size[1 - control.source] > 0 ? 1 - control.source : control.source;
  uint children = kDeviceWidth * kDeviceWidth;
  uint taken_up = min(control.stack_size[1 - source] + config.stack_reserve, config.stack_capacity);
  uint room = max((config.stack_capacity - taken_up) / (2 * children), 1);
  uint leaf_room = (config.leaf_capacity - control.leaf_pairs) / children;
  uint take = min(control.stack_size[source], min(room, leaf_room));
  control.source = source;
  control.take = take;
  control.stack_size[source] -= take;
  control.first = control.stack_size[source];
  control.walk_groups[0] = min((take + kWalkedTogether - 1) / kWalkedTogether, config.most_groups);
  control.walk_groups[1] = 1;
  control.walk_groups[2] = 1;
}
