// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "clash/cells_within.hpp"
#include "clash/deep_points.hpp"
#include "clash/defects.hpp"
#include "impinge/clash.hpp"

namespace impinge::clash {

/// A part with its measures: facts, wall thickness, and points deep inside it.
struct MeasuredPart {
  solid::Part part;
  PartFacts facts;
  double thinnest_wall = 0;  ///< the least wall of a solid and of each of its outer shells
  std::vector<DeepPoint> deep_points;
};

/// `defects` are those of the body's mesh.
MeasuredPart measured_part(solid::Body body, const Defects& defects);

}  // namespace impinge::clash
