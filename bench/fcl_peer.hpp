// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

namespace impinge::bench {

/// FCL's mesh with its tree of oriented boxes, `BVHModel<OBB<double>>`, asked for every pair of triangles and for
/// nothing else about them.
class FclMesh {
 public:
  explicit FclMesh(const scenes::MeshData& data);
  FclMesh(FclMesh&&) noexcept;
  ~FclMesh();

  /// FCL's own call alone; it keeps its result until the next one. Returns the number of pairs.
  std::size_t collide(const Pose& pose_a, const FclMesh& b, const Pose& pose_b);
  /// The pairs of the last call, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How far FCL's pairs are from the exact ones.
struct Disagreement {
  std::uint64_t missed = 0, added = 0;
};
Disagreement compare(const std::vector<TrianglePair>& exact, const std::vector<TrianglePair>& fcl);

}  // namespace impinge::bench
