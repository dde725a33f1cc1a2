// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// Meshes that break tests made for well-formed ones.
namespace impinge::scenes {

/// `n` triangles whose corners are uniform in a cube of side `size` around a point that is uniform in [0, 1]^3.
MeshData triangle_soup(Random& random, int n, double size);

/// `n` triangles with corners on the integer grid [0, side]^3: many touch, many are coplanar, some have no area.
MeshData integer_soup(Random& random, int n, int side);

/// `n` triangles of length about 1 and width `width` through [0, 1]^3, in every direction.
MeshData sliver_soup(Random& random, int n, double width = 1e-12);

/// `n` triangles without area on the integer grid [0, side]^3: points (one index three times, or three equal vertices),
/// segments (an index twice, or the third corner at an end, between the ends, or beyond one), in equal shares.
MeshData degenerate_soup(Random& random, int n, int side);

/// Each triangle `times` times in a row; copies after the first are turned and flipped.
MeshData with_duplicates(const MeshData& mesh, int times);

}  // namespace impinge::scenes
