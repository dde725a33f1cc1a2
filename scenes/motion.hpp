// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// Rigid motions as real data has them: rounded to double, so never quite rigid.
namespace impinge::scenes {

/// Uniform over all rotations; entries rounded, off an exact rotation by a few 2^-53.
std::array<double, 9> random_rotation(Random& random);

/// A random rotation, and each coordinate of t uniform in [-reach, reach].
Pose random_motion(Random& random, double reach);

/// The rotation stretched until max|RᵀR - I| is `off` (to a thousandth of it). Still a pose for `off` up to 1e-6.
std::array<double, 9> stretched_rotation(Random& random, double off = 9e-7);

/// Object by object, the pose first and `motion` after it, the product computed in double. An object at the identity
/// gets `motion` bit for bit.
PlacedScene moved(PlacedScene scene, const Pose& motion);

/// Object by object, the world vertices (computed by the formula of `Pose`) as a mesh of its own at the identity.
PlacedScene baked(const PlacedScene& scene);
MeshData baked(const MeshData& mesh, const Pose& pose);

}  // namespace impinge::scenes
