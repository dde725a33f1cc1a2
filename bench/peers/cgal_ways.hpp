// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

namespace impinge::bench {

/// Other ways to every pair of triangles with CGAL's tree, for a moving body: the tree stays in the first body's frame.
class CgalWays {
 public:
  explicit CgalWays(const scenes::MeshData& data);
  ~CgalWays();

  /// The second body's triangles brought into the first one's frame, rounded, then `all_intersected_primitives`: exact
  /// on those rounded numbers alone. By the kernel of exact predicates, and by that of exact constructions.
  void moved_triangles(const Pose& a, const Pose& b);
  void moved_triangles_epeck(const Pose& a, const Pose& b);
  /// A traversal of our own, for which CGAL's interface has room: boxes of triangles against boxes, widened by what
  /// rounding may have moved them, then `do_intersect` on the world triangles. Exact on those.
  void own_boxes(const Pose& a, const Pose& b);
  /// The same with both trees, as CGAL's own check for rigid motions walks them.
  void own_two_trees(const Pose& a, const Pose& b);

  /// What the last one found, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::bench
