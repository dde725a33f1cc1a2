// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// The buffers of a walk.
#ifndef WORK_GLSL
#define WORK_GLSL

#include "layout.h"

layout(push_constant, std430) uniform Configuration { WalkConfig config; };

layout(set = 0, binding = kControl, std430) buffer ControlBuffer { Control control; };

#endif
