// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/hash.hpp"
#include "core/mesh_data.hpp"
#include "core/shapes.hpp"
#include "scene/ignored_pairs.hpp"

namespace impinge::scene {

/// An object as the broad phase sees it. `mesh` is null where nothing is: a free place, or a mesh without triangles.
struct PlacedObject {
  const MeshData* mesh = nullptr;
  Pose pose;
  std::uint32_t group = 0;
  Sphere sphere;          ///< around the world vertices, for certain
  Box box;                ///< around the world vertices, for certain: the posed box cut with the sphere's
  bool in_domain = true;  ///< `in_range`: contacts are exact (contract 1.3)
  /// Some world vertices are not in the exact domain, so that contacts take `settle_one_by_one`.
  bool is_outside_exact_domain = false;
};

/// An unordered pair of object indices as one number.
inline std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// What a query is about.
struct SceneView {
  std::span<const PlacedObject> objects;
  const IgnoredPairs* ignored = nullptr;

  /// Whether two objects are tested against each other.
  [[nodiscard]] bool are_tested(std::uint32_t a, std::uint32_t b) const {
    const bool are_one_group = objects[a].group != 0 && objects[a].group == objects[b].group;
    return !are_one_group && (ignored == nullptr || ignored->empty() || !ignored->contains(a, b));
  }
};

/// The hash key of a mesh's and a pose's numbers (contract 2.6).
inline std::uint64_t key(const MeshData& mesh, const Pose& pose) {
  std::uint64_t key = mesh.hash;
  for (const double r : pose.R) key = mix(key, number_bits(r));
  for (const double t : pose.t) key = mix(key, number_bits(t));
  return key;
}

/// Bounds and domain of a mesh at a valid pose.
PlacedObject place(const MeshData& mesh, const Pose& pose, std::uint32_t group);

}  // namespace impinge::scene
