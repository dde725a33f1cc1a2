// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "scenes/contact_depth.hpp"

/// The paper's experiment: two bodies in mutual motion, at five sizes.
namespace impinge::bench {

/// Triangles of each body: those of the paper's Table 1, to within the one that a torus knot can have.
inline constexpr std::array kPaperSizes{968, 3162, 5200, 7590, 9612};

/// The steps of bench/poses/mutual_motion.csv, which is compiled in; with `every`, each so many-th of them.
std::vector<scenes::PosePair> mutual_motion(std::size_t every = 1);

}  // namespace impinge::bench
