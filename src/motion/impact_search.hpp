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
  FeaturesCache* cache = nullptr;  ///< keeps the order of the triangles
};

struct ImpactQuery {
  bool earliest;
  double end;
  std::uint64_t limit;
  ForEach for_each;
  std::stop_token stop;
};

/// All impacts between two meshes; of a mesh with itself where `b` is null. Throws `Stopped`.
Impacts find_impacts(const MovingMesh& a, const MovingMesh* b, const ImpactQuery& query);

}  // namespace impinge::motion
