// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

namespace impinge::hierarchy {

/// Local coordinates: x = F (2^-k v - origin), where row i of F is axis i and k is the tree's unit exponent. The map is
/// defined by exactly the numbers stored; F is orthonormal to within 2^-20 (max|F Fᵀ - I|).
struct Frame {
  double origin[4];  ///< the fourth is 0
  float axes[3][4];  ///< axes[l][i] is component l of axis i; the fourth lane is 0
  float radius;      ///< at least |x| of every point in here, in the largest coordinate
};

}  // namespace impinge::hierarchy
