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

/// 200 steps of an approach, a passage and a parting; with `every`, each so many-th of them. Both bodies turn, each
/// about its own axis, at constant speeds; the first one's centre stays on the origin, the second one's goes along a
/// line that passes it. Lengths are for torus knots, whose bounding sphere has a radius of about 3.4.
std::vector<scenes::PosePair> mutual_motion(int every = 1);

}  // namespace impinge::bench
