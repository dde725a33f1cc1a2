// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/shapes.hpp"
#include "impinge/clash.hpp"
#include "pipeline/part.hpp"

/// Keeps the results of one search for clashes, so that the next one judges only pairs with a changed object.
namespace impinge {

/// A candidate pair with its terms and its clashes.
struct JudgedPair {
  std::uint64_t objects = 0;  ///< the lower index in the upper half
  std::vector<ClashTerms> terms;
  std::vector<Clash> clashes;  ///< only those that the answer lists
  bool is_reused = false;      ///< taken over from the search before
};

/// A verdict depends on world vertices alone: it is reused while the meshes and poses of both objects are the same, bit
/// by bit.
class PreviousClashes {
 public:
  PreviousClashes() = default;
  /// `pairs` are sorted by their objects.
  PreviousClashes(const std::vector<Placed>& objects, std::vector<Part> parts, std::vector<JudgedPair> pairs,
                  const ClashOptions& options);

  /// Forgets the results that another object or option invalidates. Returns the objects, with null for the mesh of each
  /// unchanged one.
  std::vector<Placed> forget_changed(const std::vector<Placed>& objects, const ClashOptions& options);
  /// The kept body of an unchanged object; null for another.
  [[nodiscard]] const solid::Body* unchanged_body(std::size_t object) const {
    return is_unchanged(object) ? &parts_[object].placed.whole : nullptr;
  }
  /// Moves the kept parts of unchanged objects to their places.
  void move_parts_to(std::vector<Part>& parts);
  /// The kept pair of two unchanged objects judged on the same terms; null if there is none.
  [[nodiscard]] const JudgedPair* find(std::uint64_t objects, const std::vector<ClashTerms>& terms) const;

  /// How many pairs the search that filled this took over from the one before.
  [[nodiscard]] std::size_t known_pairs() const { return known_pairs_; }

 private:
  struct PlacedMesh {
    std::optional<Mesh> mesh;  ///< a reference is held, so that no later mesh can have its address
    Pose pose;
  };
  [[nodiscard]] bool is_unchanged(std::size_t object) const {
    return object < is_unchanged_.size() && is_unchanged_[object] != 0;
  }

  double depth_precision_ = 0;
  bool regions_ = false, volumes_ = false;
  std::vector<PlacedMesh> objects_;  ///< by object, as the next two
  std::vector<Part> parts_;
  std::vector<std::uint8_t> is_unchanged_;
  std::vector<JudgedPair> pairs_;
  std::size_t known_pairs_ = 0;
};

struct ClashMemory::State {
  PreviousClashes clashes;
};

}  // namespace impinge
