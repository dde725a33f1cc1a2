// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

namespace impinge::hierarchy {

/// A negligible length in a tree's unit, in which the mesh is about 1 across. It allows for what underflow takes from
/// floats and from coordinates near 0.
inline constexpr double kNothing = 0x1p-100;

/// Not less than x >= 0, and little more: rounding to float takes less than is added.
inline float round_up(double x) { return static_cast<float>(x * (1 + 0x1p-23) + kNothing); }

}  // namespace impinge::hierarchy
