// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/measures.hpp"
#include "scenes/scene.hpp"

/// A process plant made from a seed, with the verdict on every pair of its parts known by construction.
///
/// The unit is the millimetre. The plant is a block of cubic slots of 8 m, and in each stands one bay, whose parts keep
/// within a ball of 3.9 m about the slot's center: bays are at least 200 mm apart, however they are turned. A bay is
/// laid out in a frame of its own; each part is one of a few hundred meshes, placed there by an exact quarter turn and
/// a shift. Every length is a multiple of 2^-10 mm and below 2^14 mm (corners of polygons are snapped to such
/// multiples), so that whatever is flush is so exactly, in single precision too. A bay then stands upright, after a
/// quarter turn about z, which keeps all that; or it is turned at random, and flush faces are off by roundings: 2^-53
/// of the coordinates in memory, 2^-24 in a file of single precision. What penetrates does so by at least 1 mm (thin
/// sheets: by 1/8 mm), what is apart is so by at least half of that: the tolerance 2^-20 |coordinate| is 0.1 mm
/// at 100 m. Two verdicts of turned bays need a tolerance that looks at more than how deep boundaries
/// reach in: a part placed twice with other triangles, whose two boundaries are off each other by roundings everywhere,
/// is still a duplicate, and what lies inside in touch with the boundary is still inside where it sticks out by a
/// rounding.
///
/// The bays (x, y, z in the bay's own frame):
///   line   two pipelines along x, one above the other: pipe, flange, gasket, flange, pipe, elbow, pipe along y.
///          Flanges are bolted: bolts go through holes 1 mm wider in radius, heads and nuts sit on the flanges' backs.
///          Nuts fit their bolts' shanks exactly, or 3/4 mm wider. Pipes lie on supports, one side down.
///   rack   up to a dozen pipes along x side by side on three H-beams, with gaps between those of one size that are
///          wide, near, none, or negative; on top pipes along y, which rest on them, are just above, or cut in.
///   frame  four columns on plates, anchored in foundations; beams and box beams between columns, trays on top, in two
///          pieces each that meet, overlap in line, or leave a gap; a pipe through a web, one close above a beam.
///   vessel a hollow vessel on saddles, nozzles through its wall and just above it, sensors in the wall, internals
///          in its cavity: free, near and standing; a closed tank with boxes inside.
///   cells  small things, two or three to a cell of 620 mm, that stay within 500: see plant_cells.cpp.
///   store  single parts on a grid, 25 mm and more apart; fills the plant up to the wanted number of parts.
namespace impinge::scenes {

/// Pairs nearer than this are on the list.
inline constexpr double kPlantClearance = 20;

struct PlantPair {
  std::uint32_t first = 0, second = 0;  ///< objects, the lower first
  Verdict verdict = Verdict::apart;
  int inner = -1;           ///< as in `Clash`
  Interval distance{};      ///< of those that are apart: holds the exact one, before the bay was turned
  std::string_view family;  ///< what was planted
};

struct Plant {
  PlacedScene scene;
  std::vector<std::string> names;   ///< of the objects, all different
  std::vector<PlantPair> pairs;     ///< by (first, second)
  std::vector<std::uint32_t> bays;  ///< of the objects
  std::vector<bool> is_turned;      ///< of the bays
};

struct PlantOptions {
  std::uint64_t seed = 1;
  double turned = 0.3;  ///< the share of bays that are turned at random; 0: whatever is flush is so exactly
};

/// So many parts, and the verdict on every pair that is not apart or nearer than `kPlantClearance`. All other pairs are
/// apart by more than that.
Plant plant(int parts, const PlantOptions& options = {});

}  // namespace impinge::scenes
