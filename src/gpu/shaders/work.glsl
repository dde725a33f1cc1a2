// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// The buffers of a walk.
#ifndef WORK_GLSL
#define WORK_GLSL

#include "layout.h"

#define NODES_A 0
#define NODES_B 1
#define LEAVES_A 2
#define LEAVES_B 3
#define RELATIONS 4
#define SETTLED 5
#define CONTROL 6
#define STACK_0 7
#define STACK_1 8
#define LEAF_PAIRS 9
#define AGAIN 10
#define HITS 11
#define VERTICES_A 12
#define VERTICES_B 13
#define TRIANGLES_A 14
#define TRIANGLES_B 15
#define POSES 16

layout(push_constant, std430) uniform Configuration { WalkConfig config; };

layout(set = 0, binding = CONTROL, std430) buffer ControlBuffer { Control control; };

#endif
