// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/clash.hpp"
#include "scenes/scene.hpp"

/// What two closed meshes are to each other, found the plain way: for tests of scenes whose verdicts are known by
/// construction, with room to spare. It samples, so that a scene made to deceive it would.
namespace impinge::test {

struct Relation {
  Verdict verdict = Verdict::apart;
  int inner = -1;
  double distance = 0;  ///< at most `reach`
};

/// Whether triangles meet is told exactly, by `collide`; on which side points are by the angle that a mesh fills as
/// seen from them; distances triangle by triangle. Points are samples of each solid 1/32 below its surface.
Relation relation(const scenes::MeshData& a, const Pose& pose_a, const scenes::MeshData& b, const Pose& pose_b,
                  double reach);

/// Signed, positive where normals look outwards.
double volume(const scenes::MeshData& mesh);

}  // namespace impinge::test
