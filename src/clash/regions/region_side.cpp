// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/region_side.hpp"

#include "solid/locate.hpp"

namespace impinge::clash {

RegionSide::RegionSide(const solid::Part& part) : part_(part) {
  if (!part.solid) return;
  inward_.reserve(part.body.size());
  for (const std::uint32_t shell : part.topology.shell)
    inward_.push_back(shell != solid::Topology::kNoShell && part.sides[shell].front && !part.sides[shell].back);
}

Side RegionSide::side() const {
  Side side{part_.body, part_.topology.position, part_.topology.positions, {}, inward_};
  if (part_.solid)
    side.holds = [this](const Vec3& p) { return solid::winding_number(part_.body.placed, p).value_or(0) != 0; };
  return side;
}

}  // namespace impinge::clash
