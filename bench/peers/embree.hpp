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

/// A placed mesh in Embree's terms: a scene with one user geometry, whose primitives are the boxes of the triangles, in
/// float, rounded outwards. `rtcCollide` knows no other geometry, and leaves the triangles to its caller: a test in
/// plain double, as careful as such a test can be without exact arithmetic.
class EmbreeBody {
 public:
  enum class Motion : std::uint8_t {
    fixed,   ///< the slow build, the best tree
    moving,  ///< the settings that made moving cheapest: a dynamic scene whose tree is refitted
  };
  EmbreeBody(const scenes::MeshData& data, const Pose& pose, Motion motion);
  EmbreeBody(EmbreeBody&&) noexcept;
  ~EmbreeBody();

  /// Places the vertices anew and refits the tree.
  void move(const Pose& pose);
  /// The same triangles with other vertices.
  void deform(const scenes::MeshData& data, const Pose& pose);
  /// `rtcCollide` and the triangle test. Keeps the pairs.
  std::size_t collide(const EmbreeBody& b);
  /// The pairs of the last `collide`, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

  /// What Embree holds for all bodies alive.
  static std::size_t bytes_held();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::bench
