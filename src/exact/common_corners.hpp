// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "core/vec3.hpp"

namespace impinge::exact {

/// The vertices that two triangles of one mesh have in common: corner a[i] of the first is corner b[i] of the second.
struct CommonCorners {
  std::array<std::size_t, 3> a{}, b{};
  std::size_t size = 0;
};

/// By whatever tells vertices apart: indices, or coordinates. A vertex that a triangle names twice counts once.
template <class Vertices>
CommonCorners common_corners(const Vertices& a, const Vertices& b) {
  CommonCorners common;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((i > 0 && a[i] == a[0]) || (i > 1 && a[i] == a[1])) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(a[i] == b[j])) continue;
      common.a[common.size] = i, common.b[common.size++] = j;
      break;
    }
  }
  return common;
}

/// Whether two triangles that have corners in common share a point outside of these corners' convex hull, exactly.
/// Those with all three corners in common always count.
bool meet_beyond(const Triangle& a, const Triangle& b, const CommonCorners& common);

}  // namespace impinge::exact
