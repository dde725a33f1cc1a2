// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bench/support.hpp"

namespace impinge::bench {

/// Scenes that touch without crossing, as parts of an assembly do, each under random common rigid motions of both
/// bodies: FCL's pairs held against the exact ones, on the numbers that both are given.
Table touching_families(int motions);

/// Real assemblies, repeated queries. FCL is given the pairs of objects whose bounding spheres meet; impinge finds them
/// itself.
Table fcl_on_assemblies(int repeats);

}  // namespace impinge::bench
