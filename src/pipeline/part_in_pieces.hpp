// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <vector>

#include "clash/reach.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

/// A placed mesh, which must outlive it, as a part in pieces. Each piece has its triangles from a mesh of its own.
struct PartInPieces {
  std::vector<Mesh> meshes;  ///< by piece
  clash::PlacedPart part;
};

/// Pieces, classes and inner points are those of the mesh in its own frame, wherever it stands. Once it is stopped, the
/// result is meaningless.
PartInPieces place_in_pieces(const Mesh& mesh, const Pose& pose, const std::stop_token& stop = {});

}  // namespace impinge
