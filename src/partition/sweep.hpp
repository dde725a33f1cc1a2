// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hierarchy/tree_relation.hpp"
#include "hierarchy/wide_leaf.hpp"
#include "partition/embedded_stars.hpp"
#include "partition/pair_stream.hpp"

namespace impinge::partition {

/// What a sweep works with. A group of leaf pairs is prepared at once, so that none waits for its own numbers; then
/// each pair's hits are listed, and written to the stream.
struct alignas(64) SweepState {
  static constexpr std::size_t kMostInLeaf = 256;
  static constexpr std::size_t kGroup = 8;             ///< leaf pairs at once, at most
  static constexpr std::size_t kLanes = 256;           ///< with so many triangles of B, at most
  static constexpr std::size_t kStride = kLanes + 16;  ///< rows apart; see PairStream
  static constexpr std::size_t kMostLanes = 16;

  bool one_order = false;  ///< of a leaf and itself, only pairs whose second triangle is the later one
  std::span<const hierarchy::WideLeafPair> pairs;  ///< what is left, from the group at hand on
  const hierarchy::TreeRelation* relation = nullptr;
  const EmbeddedStars* stars = nullptr;  ///< pairs with such a vertex in common are left out; null: none are

  // The group at hand: B's triangles, leaf after leaf, in the frames of A's leaves, and their boxes: least and greatest
  // x, y, z, larger by what neither leaf knows exactly.
  alignas(64) float posed[9][kStride];
  alignas(64) float box_b[6][kStride];
  std::uint32_t rows[kStride];  ///< B's triangles that reach A's leaf, by their place above
  struct {
    std::uint32_t first_row, end_row;  ///< in `rows`
    std::uint32_t first_lane;          ///< of B's leaf in `posed`
    float error;
  } group[kGroup];
  std::size_t group_size, next_pair;

  // The leaf pair at hand, next_pair - 1.
  alignas(64) float box_a[6][kMostInLeaf];
  alignas(64) std::uint32_t corners_a[3][kMostInLeaf];  ///< of the stars, if any
  std::size_t next_first, end_first;                    ///< A's triangles that are still to be looked at
  struct {
    std::uint32_t row, mask;  ///< a triangle of B, and those of A, of as many as there are lanes, whose boxes it meets
  } hits[kStride];
  std::size_t hit_count, next_hit;
  /// Pairs by their lanes, and room for a vector more. Beyond the pairs there is anything, but lanes.
  static constexpr std::size_t kTile = kMostLanes * kMostLanes + kMostLanes;
  alignas(64) std::uint32_t lanes_a[kTile] = {}, lanes_b[kTile] = {};
};

/// Turns pairs of leaves into a stream of pairs of triangles whose boxes meet. B's leaves are taken into the frames of
/// A's, where the boxes of both leaves' triangles are held against each other, many at a time.
class Sweep {
 public:
  /// The work: leaf pairs of two trees, and how the second lies in the first. They stay as long as the work does.
  /// `is_self`: both are one tree in one place, whose leaves give each pair of their own triangles once, and, with
  /// `stars`, none that has an embedded star's vertex in common.
  void begin(std::span<const hierarchy::WideLeafPair> pairs, const hierarchy::TreeRelation& relation,
             bool is_self = false, const EmbeddedStars* stars = nullptr) {
    state_.pairs = pairs, state_.relation = &relation, state_.one_order = is_self, state_.stars = stars;
    state_.group_size = state_.next_pair = state_.next_first = state_.end_first = 0;
    state_.hit_count = state_.next_hit = 0;
  }

  /// Appends to the stream until it is nearly full (false: come again) or the work is done (true).
  bool fill(PairStream& stream);

 private:
  SweepState state_;
};

}  // namespace impinge::partition
