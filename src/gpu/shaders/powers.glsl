// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Powers of two, which GLSL cannot write as such. Each number is the one float nearest to it.
#ifndef POWERS_GLSL
#define POWERS_GLSL

const float kTwoToMinus15 = 3.0517578125e-5;
const float kTwoToMinus17 = 7.62939453125e-6;
const float kTwoToMinus23 = 1.1920928955078125e-7;
const float kTwoToMinus100 = 7.888609052210118e-31;
const float kTwoToMinus110 = 7.703719777548943e-34;

#endif
