// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/may_touch.hpp"

namespace impinge::broad {

bool may_touch(const scene::SceneView& view, std::uint32_t a, std::uint32_t b) {
  const scene::PlacedObject &first = view.objects[a], &second = view.objects[b];
  if (!overlap(first.box, second.box)) return false;
  // Radii and centres are certain; the two sides of the comparison are off by less than 8 eps.
  const Vec3 d = first.sphere.center - second.sphere.center;
  const double reach = first.sphere.radius + second.sphere.radius;
  if (dot(d, d) > reach * reach * (1 + 0x1p-49)) return false;
  if (first.group != 0 && first.group == second.group) return false;
  return view.ignored == nullptr || view.ignored->empty() || !view.ignored->contains(scene::pair_key(a, b));
}

}  // namespace impinge::broad
