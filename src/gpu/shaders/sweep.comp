// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#version 450
#extension GL_GOOGLE_include_directive : require

// Where the device has no doubles, or none that can be trusted.

#include "sweep.glsl"
