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

enum class FclBuild : std::uint8_t {
  debian,      ///< the library that Debian compiled, for any processor of the architecture
  same_flags,  ///< the same headers, compiled as impinge is: -O3, for any processor unless the build says otherwise
  native,      ///< the same headers, compiled by -O3 for this very processor
};

/// FCL's mesh with its tree of oriented boxes, `BVHModel<OBB<double>>`, asked for pairs of triangles and for nothing
/// else about them.
template <FclBuild Build>
class FclMesh {
 public:
  explicit FclMesh(const scenes::MeshData& data);
  FclMesh(FclMesh&&) noexcept;
  ~FclMesh();

  /// The same triangles with other vertices: the tree keeps its shape, and its boxes are fitted from the bottom up.
  void refit(const scenes::MeshData& data);

  /// FCL's own call alone; it keeps its result until the next one. Returns the number of pairs.
  std::size_t collide(const Pose& pose_a, const FclMesh& b, const Pose& pose_b,
                      std::size_t limit = std::numeric_limits<std::size_t>::max());
  /// The pairs of the last call, sorted.
  [[nodiscard]] std::vector<TrianglePair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

using FclDebianMesh = FclMesh<FclBuild::debian>;
using FclSameFlagsMesh = FclMesh<FclBuild::same_flags>;
using FclNativeMesh = FclMesh<FclBuild::native>;
extern template class FclMesh<FclBuild::debian>;
extern template class FclMesh<FclBuild::same_flags>;
extern template class FclMesh<FclBuild::native>;

}  // namespace impinge::bench
