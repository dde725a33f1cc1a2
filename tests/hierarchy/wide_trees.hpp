// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hierarchy/wide_tree.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {

/// All that is left of a tree in one string, nodes and leaves in the order of a walk that makes what is not made yet.
inline std::string bytes_of(hierarchy::WideTree& tree) {
  std::string bytes;
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const auto put_frame = [&](const hierarchy::Frame& frame) { put(frame.origin), put(frame.axes), put(frame.radius); };
  hierarchy::MadeNodes made;
  std::vector<hierarchy::TreeRef> open{tree.root(made)};
  while (!open.empty()) {
    const hierarchy::TreeRef next = open.back();
    open.pop_back();
    if (next.is_leaf()) {
      const hierarchy::WideLeaf& leaf = next.leaf();
      put_frame(leaf.frame);
      put(leaf.half), put(leaf.error), put(leaf.inverse_error), put(leaf.count), put(leaf.stride);
      bytes.append(reinterpret_cast<const char*>(leaf.row(0)), 10 * sizeof(float) * leaf.stride);
    } else {
      hierarchy::WideNode& node = next.node();
      put_frame(node.frame);
      put(node.center), put(node.half), put(node.size), put(node.count), put(node.depth);
      for (std::uint32_t lane = 0; lane < node.size; ++lane)
        open.push_back(tree.child(node, static_cast<int>(lane), made));
    }
  }
  return bytes;
}

}  // namespace impinge::test
