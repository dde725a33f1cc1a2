// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "bench/peers/fcl.hpp"

namespace impinge::bench {

/// FCL's mesh with the tree that its manual recommends for distances, `BVHModel<OBBRSS<double>>`.
template <FclBuild Build>
class FclDistanceMesh {
 public:
  explicit FclDistanceMesh(const scenes::MeshData& data);
  FclDistanceMesh(FclDistanceMesh&&) noexcept;
  ~FclDistanceMesh();

  /// The distance and nearest points, of which the distance is returned; FCL's own call alone.
  double distance(const Pose& pose_a, const FclDistanceMesh& b, const Pose& pose_b);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class FclDistanceMesh<FclBuild::debian>;
extern template class FclDistanceMesh<FclBuild::native>;

}  // namespace impinge::bench
