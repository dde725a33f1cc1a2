// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "exact/contact.hpp"
#include "hierarchy/wide_walk.hpp"
#include "impinge/contacts.hpp"
#include "narrow/pair_filter.hpp"
#include "partition/sweep.hpp"
#include "pipeline/query.hpp"
#include "pipeline/stage_clock.hpp"
#include "results/contact_key.hpp"

namespace impinge {

/// The stages from hierarchy to exact, fast: wide trees, boxes and triangles many at a time in certified single
/// precision. One thread uses it at a time.
class FastStages {
 public:
  /// What remains to be walked is a stack of these.
  using Step = hierarchy::TreeRefPair;

  /// What the stages need of one pair of objects. Its first tree is that of the larger unit.
  struct Pair {
    Pair(const Query& query, const broad::ObjectPair& objects);
    Pair(const PlacedMesh& first, const PlacedMesh& second, const ForEach& for_each);
    /// Whether the second mesh's tree comes first.
    static bool is_swapped(const MeshState& first, const MeshState& second);
    bool swapped;                           ///< the first tree is that of the pair's second object
    bool is_self = false;                   ///< both are one object
    Adjacency adjacency{};                  ///< then
    const MeshState* own = nullptr;         ///< then
    const std::stop_token* stop = nullptr;  ///< then
    const scene::PlacedObject &a, &b;
    hierarchy::WideWalk walk;
    [[nodiscard]] bool is_outside_exact_domain() const {
      return a.is_outside_exact_domain || b.is_outside_exact_domain;
    }
  };

  /// What is looked for, and the kinds that are wanted. Nothing is found yet.
  void configure(Options::Find find, std::uint8_t kinds);

  /// The stages, in order, on part of one pair of objects. `fresh`: from the roots.
  void run_slice(const Pair& pair, bool fresh, std::vector<Step>& stack, StageClock& clock, Statistics& statistics);
  /// Whether what the last slices left is enough for another thread: to hand it over costs more than a small slice.
  [[nodiscard]] bool is_worth_sharing() const;
  /// Before the first slice of what was handed over.
  void resume();
  /// Of the last slice, of the wanted kinds.
  [[nodiscard]] std::span<const results::ContactKey> contacts() const { return keys_; }

 private:
  void decide(const Pair& pair, std::span<const hierarchy::WideLeafPair> leaf_pairs, StageClock& clock,
              Statistics& statistics);
  [[nodiscard]] const partition::EmbeddedStars* stars_of(const Pair& pair) const;
  void decide_neighbours(const Pair& pair);

  bool first_only_ = false;
  bool any_is_enough_ = false;  ///< then, of any kind
  std::uint8_t kinds_ = kAllKinds;
  unsigned slices_ = 0;        ///< of a search for one contact
  std::size_t looked_at_ = 0;  ///< leaf pairs of such a search
  std::vector<hierarchy::WideLeafPair> leaf_pairs_;
  partition::Sweep sweep_;
  partition::PairStream stream_;
  narrow::Filtered filtered_;
  std::vector<exact::Contact> contacts_;
  std::vector<results::ContactKey> keys_;
};

}  // namespace impinge
