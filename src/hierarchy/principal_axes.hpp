// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace impinge::hierarchy {

/// Orthonormal axes along the eigenvectors of a symmetric matrix, in no certain order: the matrix is {xx, yy, zz, xy,
/// yz, zx}, `axes[l][i]` component l of axis i. Orthonormal to within 2^-22 (max|F Fᵀ - I|) whatever the matrix, as
/// long as it is finite; along the eigenvectors to about 1e-6.
void principal_axes(const std::array<double, 6>& matrix, float axes[3][4]);

}  // namespace impinge::hierarchy
