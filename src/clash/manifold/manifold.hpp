// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clash/manifold/inner_vertices.hpp"
#include "clash/manifold/touch.hpp"
#include "core/disjoint_sets.hpp"
#include "impinge/contacts.hpp"
#include "impinge/manifolds.hpp"

namespace impinge::clash {

/// The contacts of two surfaces, sorted by a and then b.
struct ContactRow {
  std::array<PlacedSurface, 2> surfaces;
  std::span<const TrianglePair> pairs;
};

/// A point that may be chosen, in the local frame, with its depth.
struct ManifoldCandidate {
  Vec3 point;
  double depth;
};

/// Makes the manifolds of one pair of surfaces after the other (impinge/manifolds.hpp), without objects and ids, in
/// memory that it keeps.
class ManifoldMaker {
 public:
  /// Appends them, in the order of their first contacts.
  void append(const ContactRow& row, std::vector<Manifold>& manifolds);

 private:
  struct Slot {
    std::uint64_t key;
    std::uint32_t touch;
    std::uint32_t round;
  };
  void list_touches(const ContactRow& row);
  void group(const std::array<PlacedSurface, 2>& surfaces);
  std::uint32_t first_at(std::uint64_t key, std::uint32_t touch);
  Manifold measure(std::span<const std::uint32_t> region, const std::array<PlacedSurface, 2>& surfaces);

  std::vector<Touch> touches_;
  std::vector<Slot> slots_;  ///< an open hash table of pairs of positions
  std::uint32_t round_ = 0;
  DisjointSets groups_;  ///< of touches
  std::vector<std::uint32_t> order_;
  InnerVertices inner_;
  std::vector<Vec3> contour_;
  std::vector<ManifoldCandidate> candidates_;
};

}  // namespace impinge::clash
