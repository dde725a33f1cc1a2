// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "hierarchy/soup_frame.hpp"
#include "hierarchy/triangle_soup.hpp"
#include "hierarchy/wide_tree.hpp"

namespace impinge::hierarchy {

/// The parts of a range of triangles, one behind the other, and the box of each in the frame (multiplied by its scale).
struct WideSplit {
  SoupFrame frame;
  std::uint32_t size = 0;
  std::uint32_t count[kWidth] = {};
  float lo[kWidth][3], hi[kWidth][3];
};

struct SplitOptions {
  Vec3 base;                ///< of the soup
  std::uint32_t leaf_size;  ///< parts of at most so many are not split
  bool halve = false;       ///< by count alone, which bounds the depth of any tree
};

/// Puts the triangles in the order of 2 to 8 parts. There are more than `leaf_size` of them.
WideSplit split(std::span<SoupTriangle> triangles, const SplitOptions& options, const ForEach& for_each);

}  // namespace impinge::hierarchy
