// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "scenes/random.hpp"

/// Two meshes placed at a chosen depth, as the benchmarks of collision libraries do.
namespace impinge::scenes {

struct PosePair {
  Pose a, b;
};

/// Both meshes randomly turned, their sphere centres on a random line. B comes from outside along the line; the last
/// place where nothing touches is found by bisection, and B goes `depth` bounding-sphere diameters of A beyond it
/// (below 0: stays so far in front of it). Bisection finds one crossing from apart to touching, for most shapes the
/// first.
Result<PosePair> near_first_touch(Random& random, const Mesh& a, const Mesh& b, double depth);

/// Both randomly turned, so far apart along a random line that about `contacts` pairs of triangles touch: to within a
/// tenth where bisection finds such a place, and as near as it came otherwise.
Result<PosePair> with_contacts(Random& random, const Mesh& a, const Mesh& b, std::size_t contacts);

/// Both randomly turned, sphere centres `distance` bounding-sphere diameters of A apart.
PosePair centers_apart(Random& random, const Mesh& a, const Mesh& b, double distance);

/// Two copies in contact that turn, about different axes and by 0.4 degrees a step, while one passes through the other
/// by 0.0014 bounding-sphere diameters a step.
std::vector<PosePair> small_steps(const Mesh& mesh, int steps);

}  // namespace impinge::scenes
