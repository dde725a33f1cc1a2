// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cfloat>

// What exactness rests on: each product and sum is rounded once, to double. See cmake/options.cmake for fused
// operations.
#if defined(__FAST_MATH__)
#error "impinge cannot be compiled with -ffast-math: its answers would be wrong"
#endif
static_assert(FLT_EVAL_METHOD == 0, "impinge needs doubles evaluated as doubles; on x86 compile for SSE2");
