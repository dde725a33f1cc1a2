// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

namespace impinge::bench {

/// A placed mesh in CGAL's terms: `AABB_tree` over its world triangles, with the kernel of exact predicates (EPICK),
/// whose `do_intersect` decides exactly on the doubles that it is given. The tree is made when it is first needed.
class CgalBody {
 public:
  CgalBody(const scenes::MeshData& data, const Pose& pose);
  CgalBody(CgalBody&&) noexcept;
  ~CgalBody();

  void build_tree() const;
  /// `all_intersected_primitives` of this body's tree for each triangle of `b` that may meet its box. Keeps the pairs.
  std::size_t collide(const CgalBody& b);
  /// The same until something meets, by `do_intersect`.
  bool touches(const CgalBody& b) const;
  /// The pairs of the last `collide`, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A closed surface as CGAL's `Surface_mesh`.
class CgalSurface {
 public:
  explicit CgalSurface(const scenes::MeshData& data);
  ~CgalSurface();

  /// `Polygon_mesh_processing::self_intersections`, on one thread: the pairs, sorted.
  [[nodiscard]] std::vector<TrianglePair> self_intersections() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::bench
