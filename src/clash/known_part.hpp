// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "clash/deep_points.hpp"
#include "clash/defects.hpp"
#include "clash/near_cells.hpp"
#include "impinge/clash.hpp"

namespace impinge::clash {

/// A part to be judged, with its facts.
struct KnownPart {
  LinkedPart linked;
  PartFacts facts;
  double thinnest_wall = 0;  ///< of a solid's wall and those of its outer shells alone
  std::vector<DeepPoint> deep_points;
};

/// `defects` are the body's own.
KnownPart know(solid::Body body, const Defects& defects);

}  // namespace impinge::clash
