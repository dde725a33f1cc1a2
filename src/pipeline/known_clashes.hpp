// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/shapes.hpp"
#include "impinge/clash.hpp"
#include "pipeline/seen_part.hpp"

/// What one search for clashes leaves to the next.
namespace impinge {

/// A candidate and all that was said of it.
struct JudgedPair {
  std::uint64_t objects = 0;  ///< the lower one in the upper half
  std::vector<ClashTerms> terms;
  std::vector<Clash> clashes;  ///< those that are listed
  bool is_known = false;       ///< from the search before
};

/// Verdicts are about world vertices alone: what has the same mesh and the same pose, bit by bit, is what it was.
class KnownClashes {
 public:
  KnownClashes() = default;
  /// `pairs` are sorted by objects.
  KnownClashes(const std::vector<Placed>& objects, std::vector<SeenPart> parts, std::vector<JudgedPair> pairs,
               const ClashOptions& options);

  /// Forgets what does not hold of these objects. Returns them without those that are known.
  std::vector<Placed> forget_changed(const std::vector<Placed>& objects, const ClashOptions& options);
  /// Each object's box: of those that are known as they are, of the others as their bodies have it.
  [[nodiscard]] std::vector<Box> boxes(const std::vector<solid::Body>& others) const;
  /// Puts the parts that are known in their places.
  void move_parts_to(std::vector<SeenPart>& parts);
  /// What was said of two objects on these terms; null if that is not known.
  [[nodiscard]] const JudgedPair* find(std::uint64_t objects, const std::vector<ClashTerms>& terms) const;

  /// How many pairs the search that filled it took over from the one before.
  [[nodiscard]] std::size_t known_pairs() const { return known_pairs_; }

 private:
  struct Stand {
    std::optional<Mesh> mesh;  ///< held, so that no later one can be mistaken for it
    Pose pose;
  };
  [[nodiscard]] bool is_known(std::size_t object) const { return object < is_known_.size() && is_known_[object] != 0; }

  std::optional<double> tolerance_;
  bool depth_ = false, regions_ = false;
  std::vector<Stand> stands_;  ///< by object, as all that follows but the pairs
  std::vector<SeenPart> parts_;
  std::vector<std::uint8_t> is_known_;  ///< not changed
  std::vector<JudgedPair> pairs_;
  std::size_t known_pairs_ = 0;
};

struct ClashMemory::State {
  KnownClashes clashes;
};

}  // namespace impinge
