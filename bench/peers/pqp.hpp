// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "scenes/scene.hpp"

namespace impinge::bench {

/// A `PQP_Model`: RAPID's successor, with swept rectangles beside its oriented boxes.
class PqpMesh {
 public:
  explicit PqpMesh(const scenes::MeshData& data);
  PqpMesh(PqpMesh&&) noexcept;
  ~PqpMesh();

  /// `PQP_Collide`: every pair, or with a limit of 1 the first. Returns the number of pairs.
  std::size_t collide(const Pose& pose_a, const PqpMesh& b, const Pose& pose_b,
                      std::size_t limit = std::numeric_limits<std::size_t>::max());
  /// The pairs of the last `collide`, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::bench
