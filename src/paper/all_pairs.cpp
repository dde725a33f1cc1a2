// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/all_pairs.hpp"

#include "broad/may_touch.hpp"

namespace impinge::paper {

broad::ObjectPairs all_pairs(const scene::SceneView& view) {
  broad::ObjectPairs pairs;
  const auto n = static_cast<std::uint32_t>(view.objects.size());
  for (std::uint32_t a = 0; a < n; ++a) {
    for (std::uint32_t b = a + 1; b < n; ++b) {
      if (broad::may_touch(view, a, b)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

}  // namespace impinge::paper
