// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes/shapes.hpp"
#include "tests/hierarchy/wide_trees.hpp"
#include "tests/memory/own_allocator.hpp"

namespace impinge {
namespace {

using test::countdown;

/// Every node and leaf is tried with one allocation more each time, until it is made: what is there stays, and in the
/// end it is the tree that it would have been.
TEST(WideTree, IsWholeInTheEndHoweverOftenMemoryRanOut) {
  scenes::MeshData numbers = scenes::torus_knot_of(3162);
  numbers.add_triangle({1e8, 0, 0, 1e8, 0, 0, 1e8, 0, 0});  // so that ranges get bases of their own
  const Mesh mesh = test::mesh_of(numbers);
  hierarchy::WideTree plain(test::numbers_of(mesh), 16);
  const std::string expected = test::bytes_of(plain);
  int failures = 0;
  for (long allowed = 0; allowed < 40; ++allowed) {
    hierarchy::WideTree tree(test::numbers_of(mesh), 16);
    hierarchy::MadeNodes made;
    std::vector<hierarchy::TreeRef> open;
    // One after the other, each tried with as few allocations as it takes.
    const auto insist = [&](const auto& make) {
      for (long granted = allowed % 5;; ++granted) {
        countdown = granted;
        try {
          const std::uint64_t before = made.nodes;
          const hierarchy::TreeRef ref = make();
          countdown = -1;
          EXPECT_EQ(made.nodes, before + 1);
          return ref;
        } catch (const std::bad_alloc&) {
          countdown = -1;
          ++failures;
        }
      }
    };
    open.push_back(insist([&] { return tree.root(made); }));
    while (!open.empty()) {
      const hierarchy::TreeRef next = open.back();
      open.pop_back();
      if (next.is_leaf()) continue;
      for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
        open.push_back(insist([&] { return tree.child(next.node(), static_cast<int>(lane), made); }));
    }
    ASSERT_TRUE(test::bytes_of(tree) == expected);
  }
  EXPECT_GT(failures, 500);
}

}  // namespace
}  // namespace impinge
