// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Numbers as the sum of two floats. A device rounds each sum and product in a direction of its own choice, by less than
// u = 2^-23 of the result, and may take for zero what is below 2^-126. `precise` forbids every other liberty: nothing is
// fused, exchanged or left out.
#ifndef TWO_FLOATS_GLSL
#define TWO_FLOATS_GLSL

struct TwoFloats {
  float hi, lo;
};

// Adds x. The larger comes first: then s - larger is exact in whatever direction s was rounded. (With smaller <= larger
// in magnitude, either the sum itself is exact, where they nearly cancel; or s lies between half and twice the larger,
// and the difference of two such floats is one.) So `rest` is off by u of itself alone, which is u^2 of s.
TwoFloats add(TwoFloats sum, float x) {
  precise float larger = abs(sum.hi) >= abs(x) ? sum.hi : x;
  precise float smaller = abs(sum.hi) >= abs(x) ? x : sum.hi;
  precise float s = larger + smaller;
  precise float taken = s - larger;
  precise float rest = smaller - taken;
  precise float lo = sum.lo + rest;
  return TwoFloats(s, lo);
}

// Adds (a.hi + a.lo) (b.hi + b.lo), but for the product of both small parts. Cut after 12 bits, hi's parts have exact
// products in every direction of rounding.
TwoFloats add_product(TwoFloats sum, TwoFloats a, TwoFloats b) {
  precise float a_head = uintBitsToFloat(floatBitsToUint(a.hi) & 0xFFFFF000u);
  precise float b_head = uintBitsToFloat(floatBitsToUint(b.hi) & 0xFFFFF000u);
  precise float a_tail = a.hi - a_head;
  precise float b_tail = b.hi - b_head;
  precise float heads = a_head * b_head;
  precise float left = a_head * b_tail;
  precise float right = a_tail * b_head;
  sum = add(add(add(sum, heads), left), right);
  precise float tails = a_tail * b_tail;
  precise float small_b = a.hi * b.lo;
  precise float small_a = a.lo * b.hi;
  precise float lo = ((sum.lo + tails) + small_b) + small_a;
  return TwoFloats(sum.hi, lo);
}

// The same number, with lo below u of hi.
TwoFloats renormalised(TwoFloats x) {
  return add(TwoFloats(x.hi, 0.0), x.lo);
}

#endif
