// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/may_touch.hpp"

namespace impinge::broad {

bool may_touch(const scene::SceneView& view, std::uint32_t a, std::uint32_t b) {
  const scene::PlacedObject &first = view.objects[a], &second = view.objects[b];
  if (!bounds_meet(first, second)) return false;
  if (first.group != 0 && first.group == second.group) return false;
  return view.ignored == nullptr || view.ignored->empty() || !view.ignored->contains(a, b);
}

}  // namespace impinge::broad
