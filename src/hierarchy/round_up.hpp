// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

namespace impinge::hierarchy {

/// In a tree's unit, of which its mesh is about one across, a length too small to matter: where floats, and coordinates
/// near nothing, lose digits because their exponents end.
inline constexpr double kNothing = 0x1p-100;

/// Not less than x >= 0, and little more: rounding to float takes less than is added.
inline float round_up(double x) { return static_cast<float>(x * (1 + 0x1p-23) + kNothing); }

}  // namespace impinge::hierarchy
