// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "impinge/clash.hpp"
#include "solid/body.hpp"
#include "solid/inner_points.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// A piece of a body: what verdicts go by.
struct ClassedPiece {
  PartClass part_class = PartClass::surface;
  std::vector<std::array<std::uint32_t, 3>>
      triangles;                         ///< by vertices of the body's mesh, turned; without shells within the material
  std::vector<InnerPoint> inner_points;  ///< in the world, of up to 64 triangles
  double radius = 0;                     ///< the largest of theirs
};

/// The pieces with their inner points. Once it is stopped, the result is meaningless.
std::vector<ClassedPiece> classed_pieces(const Body& body, const Topology& topology, const std::stop_token& stop);

}  // namespace impinge::solid
