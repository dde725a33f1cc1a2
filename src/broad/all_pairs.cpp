// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/all_pairs.hpp"

#include "broad/may_touch.hpp"

namespace impinge::broad {

ObjectPairs all_pairs(const scene::SceneView& view) {
  ObjectPairs pairs;
  const auto n = static_cast<std::uint32_t>(view.objects.size());
  for (std::uint32_t a = 0; a < n; ++a) {
    if (view.objects[a].mesh == nullptr) continue;
    for (std::uint32_t b = a + 1; b < n; ++b) {
      if (view.objects[b].mesh == nullptr || !may_touch(view, a, b)) continue;
      pairs.push_back({a, b, intersection(view.objects[a].box, view.objects[b].box)});
    }
  }
  return pairs;
}

}  // namespace impinge::broad
