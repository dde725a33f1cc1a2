// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scene/scene_view.hpp"

#include "core/hash.hpp"

namespace impinge::scene {
std::uint64_t key(const MeshData& mesh, const Pose& pose) {
  std::uint64_t key = mesh.hash;
  for (const double r : pose.R) key = mix(key, number_bits(r));
  for (const double t : pose.t) key = mix(key, number_bits(t));
  return key;
}

}  // namespace impinge::scene
