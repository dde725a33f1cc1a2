// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "core/for_each.hpp"
#include "impinge/impacts.hpp"
#include "motion/features.hpp"
#include "motion/path_tree.hpp"

namespace impinge::motion {

struct MovingMesh {
  Vertices vertices;
  const Features& features;
  const PathTree& tree;  ///< of its triangles; all trees of a query are made by one plan
};

struct ImpactQuery {
  bool earliest;
  double end;  ///< no later than that of the trees
  double separation;
  float reach;  ///< boxes farther apart than this, in the trees' frame, are so by more than the separation and its
                ///< tolerance
  std::uint64_t limit;
  ForEach for_each;
  std::stop_token stop;
};

/// All impacts between two meshes; of a mesh with itself where `b` is null. Throws `Stopped`.
Impacts find_impacts(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query);

}  // namespace impinge::motion
