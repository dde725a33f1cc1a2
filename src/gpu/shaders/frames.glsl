// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

#ifndef FRAMES_GLSL
#define FRAMES_GLSL

#include "layout.h"
#include "powers.glsl"
#include "two_floats.glsl"

/// How one frame of B lies in one of A: x = C (scale y) + c. With u = 2^-23, C's entries are within 10 u of
/// F_A M F_B^T's, which are at most 1.0001: M is taken in single precision (u), its product with F_B's axes adds three
/// products' and sums' roundings (3 u), the product with F_A's brings sqrt(3) times that and 3 u more.
struct FrameRelation {
  float C[9];  // by rows
  float c[3];
};

// c = F_A (M scale o_B + t - o_A). The sum in brackets is within 2^-37 m of the exact one, with m the sum of its terms'
// magnitudes, which the host counts into the relation's error: eleven `add`s leave u^2 m each, the products' small parts
// another u^2, and the 22 sums of small parts, which are below 2^-19 m, are rounded by u. In F_A's three products and two
// sums 7 u of the largest coordinate of c, rounded up to 9 u for the small parts.
// Turned by F_A that may be sqrt(3) of it in one coordinate: users take the relation's error twice.
FrameRelation relate_frames(DeviceFrame a, DeviceFrame b, DeviceRelation relation) {
  FrameRelation result;
  TwoFloats offset[3];
  for (int i = 0; i < 3; ++i) {
    TwoFloats sum = TwoFloats(relation.t_hi[i], relation.t_lo[i]);
    for (int k = 0; k < 3; ++k) {
      TwoFloats m = TwoFloats(relation.m_hi[3 * i + k], relation.m_lo[3 * i + k]);
      precise float hi = relation.scale * b.origin_hi[k];  // by a power of two
      precise float lo = relation.scale * b.origin_lo[k];
      sum = add_product(sum, m, TwoFloats(hi, lo));
    }
    sum = add(sum, -a.origin_hi[i]);
    precise float rest = sum.lo - a.origin_lo[i];
    offset[i] = renormalised(TwoFloats(sum.hi, rest));
  }
  float product[9];  // M F_B^T
  for (int l = 0; l < 3; ++l) {
    for (int k = 0; k < 3; ++k) {
      precise float sum = (relation.m_hi[3 * l] * b.axes[k] + relation.m_hi[3 * l + 1] * b.axes[3 + k]) +
                          relation.m_hi[3 * l + 2] * b.axes[6 + k];
      product[3 * l + k] = sum;
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      precise float sum =
          (a.axes[i] * product[k] + a.axes[3 + i] * product[3 + k]) + a.axes[6 + i] * product[6 + k];
      result.C[3 * i + k] = sum;
    }
    precise float small =
        (a.axes[i] * offset[0].lo + a.axes[3 + i] * offset[1].lo) + a.axes[6 + i] * offset[2].lo;
    precise float large =
        (a.axes[i] * offset[0].hi + a.axes[3 + i] * offset[1].hi) + a.axes[6 + i] * offset[2].hi;
    precise float c = large + small;
    result.c[i] = c;
  }
  return result;
}

#endif
