// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene_view.hpp"

namespace impinge::broad {

/// Whether two spheres may share a point. Radii and centres are certain; the two sides of the comparison are off by
/// less than 8 eps.
inline bool spheres_meet(const Sphere& a, const Sphere& b) {
  const Vec3 d = a.center - b.center;
  const double reach = a.radius + b.radius;
  return !(dot(d, d) > reach * reach * (1 + 0x1p-49));
}

/// Whether the bounds of two objects meet: spheres, which are quick to compare, and boxes (section 3.2 of the paper).
inline bool bounds_meet(const scene::PlacedObject& a, const scene::PlacedObject& b) {
  return a.mesh != nullptr && b.mesh != nullptr && spheres_meet(a.sphere, b.sphere) && overlap(a.box, b.box);
}

/// Whether two objects are to be tested, and their bounds meet.
inline bool may_touch(const scene::SceneView& view, std::uint32_t a, std::uint32_t b) {
  return bounds_meet(view.objects[a], view.objects[b]) && view.are_tested(a, b);
}

}  // namespace impinge::broad
