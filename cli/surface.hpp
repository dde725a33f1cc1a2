// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "impinge/mesh.hpp"

namespace impinge::cli {

/// What can be said of a placed mesh as a surface, exactly, on its world vertices.
struct Surface {
  std::uint64_t degenerate = 0;  ///< triangles whose vertices are collinear
  std::uint64_t open_edges = 0;  ///< edges that are not used by as many triangles one way as the other
  bool closed = false;           ///< no open edges, and at least one triangle that has an area
  bool in_domain = true;         ///< false: coordinates on which nothing is exact; the rest is then unknown
};

/// Corners are the same where their coordinates are exactly equal; edges join two different corners. A triangle with
/// two equal corners uses its edge once each way, so it opens and closes nothing.
Surface inspect(const Mesh& mesh, const Pose& pose);

}  // namespace impinge::cli
