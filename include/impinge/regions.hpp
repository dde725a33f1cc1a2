// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"

namespace impinge {

/// One connected region of contact between two placed meshes.
struct Region {
  std::uint64_t pairs = 0;     ///< of triangles
  std::array<Point, 2> box{};  ///< lowest and highest corner of what the pairs share
  double area = 0;             ///< what coplanar pairs share, and what the closed lines of crossing ones enclose
  double length = 0;           ///< of the lines
  Point centroid{};            ///< of the area, or without one of the lines, or of the points
  Point normal{};              ///< unit: the mean direction from a to b; 0 where there is none
  std::vector<std::vector<Point>>
      lines;  ///< where the surfaces meet; ends are exact but for one rounding; closed ones end where they begin
  std::vector<std::uint32_t> triangles_a, triangles_b;  ///< sorted
};

/// The regions of contact between a and b, largest first (by area, then length, then pairs). Pairs of triangles belong
/// together where their triangles are the same or neighbours (by position), and where a part of one surface that lies
/// inside the other joins them: a bolt through a plate is one region.
/// Errors: as `collide`.
Result<std::vector<Region>> contact_regions(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b,
                                            const Pose& pose_b, const MeasureOptions& options = {});

}  // namespace impinge
