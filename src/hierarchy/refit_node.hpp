// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hierarchy/wide_tree.hpp"

namespace impinge::hierarchy {

/// Along a node's axes, of a child.
struct ChildBox {
  float lo[3], hi[3];
  float radius;  ///< the largest of the leaves below
};

/// What a child of a node has become: itself, and the leaves below in their order.
struct RefittedChild {
  TreeRef ref;
  std::span<const WideLeaf* const> leaves;
};

/// A node whose children have been refitted: its frame is the old node's, turned as theirs, and its boxes hold what the
/// leaves below hold.
void refit_node(const WideNode& old, const RefittedChild (&children)[kWidth], WideNode& node);

}  // namespace impinge::hierarchy
