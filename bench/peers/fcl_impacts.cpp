// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/fcl_impacts.hpp"

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

namespace impinge::bench {

std::size_t FclImpacts::count(const std::vector<double>& from, const std::vector<double>& to,
                              std::span<const FclFeatures> pairs) {
  using Intersect = fcl::detail::Intersect<double>;
  using Point = fcl::Vector3<double>;
  std::size_t hits = 0;
  double time;
  Point place;
  for (const FclFeatures& pair : pairs) {
    Point p[8];
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t at = 3 * std::size_t{pair.vertices[i]};
      p[i] = Point(from[at], from[at + 1], from[at + 2]), p[4 + i] = Point(to[at], to[at + 1], to[at + 2]);
    }
    hits += std::size_t{pair.on_edges
                            ? Intersect::intersect_EE(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], &time, &place)
                            : Intersect::intersect_VF(p[1], p[2], p[3], p[0], p[5], p[6], p[7], p[4], &time, &place)};
  }
  return hits;
}

}  // namespace impinge::bench
