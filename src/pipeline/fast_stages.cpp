// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/fast_stages.hpp"

#include <algorithm>

#include "exact/settle.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/self_pair.hpp"

namespace impinge {
namespace {

// A slice of work: long enough that clocks and hand-overs do not show, short enough that threads share one large pair.
constexpr hierarchy::WalkLimits kSlice{.leaf_pairs = 512, .box_tests = 65536};

/// A search for one contact begins with a single pair of leaves and takes on twice as much with each slice: it ends
/// soon where contacts abound, and where there are none it costs little more than the search for all.
hierarchy::WalkLimits first_slice(unsigned number) {
  const std::size_t effort = std::size_t{1} << std::min(number, 9u);
  return {.leaf_pairs = effort,
          .box_tests = 1024 * effort,
          .at_once = std::min(effort, hierarchy::WalkLimits::kMostAtOnce),
          .nearest_first = true};
}

/// After so many slices without a contact the search leaves the branch that gave none, and again after each that
/// follows.
constexpr unsigned kPatientSlices = 4;

/// The older half, of larger subtrees, comes to the top.
void turn_over(std::vector<hierarchy::TreeRefPair>& stack) {
  std::rotate(stack.begin(), stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2), stack.end());
}

std::uint32_t bits_of(const exact::CommonCorners& common) {
  std::uint32_t bits = 0;
  if (common.size == 3) return 0;  // those always count
  for (std::size_t i = 0; i < common.size; ++i) bits |= 1u << common.a[i] | 8u << common.b[i];
  return bits;
}

/// By position, vertices that are in one place in the mesh: in the world they are in one place too.
void mark_common_corners(const MeshData& mesh, Adjacency adjacency, partition::PairStream& stream) {
  const auto corners = [&mesh](std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return Triangle{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
  };
  for (std::size_t i = 0; i < stream.size; ++i) {
    const std::uint32_t a = stream.id_a[i], b = stream.id_b[i];
    stream.common[i] =
        bits_of(adjacency == Adjacency::by_index ? exact::common_corners(mesh.triangles[a], mesh.triangles[b])
                                                 : exact::common_corners(corners(a), corners(b)));
  }
}

}  // namespace

FastStages::Pair::Pair(const Query& query, const broad::ObjectPair& objects)
    : Pair(query.placed(objects.a), query.placed(objects.b), on_threads(query.options.threads)) {
  is_self = walk.is_self = objects.a == objects.b;
  adjacency = query.options.adjacency;
}

FastStages::Pair::Pair(const PlacedMesh& first, const PlacedMesh& second, const ForEach& for_each)
    : swapped(first.mesh.wide_tree.unit_exponent() < second.mesh.wide_tree.unit_exponent()),
      a((swapped ? second : first).object),
      b((swapped ? first : second).object),
      walk{(swapped ? second : first).mesh.wide_tree, (swapped ? first : second).mesh.wide_tree, {}, for_each} {
  walk.relation = hierarchy::relate(*a.mesh, a.pose, walk.a.unit_exponent(), *b.mesh, b.pose, walk.b.unit_exponent());
}

void FastStages::configure(const Options& options) {
  first_only_ = options.find == Options::Find::first;
  sweep_.configure(options.partition);
}

void FastStages::run_slice(const Pair& pair, bool fresh, std::vector<Step>& stack, StageClock& clock,
                           Statistics& statistics) {
  hierarchy::WalkCounts counts;
  leaf_pairs_.clear(), keys_.clear();
  if (fresh) pair.walk.start(stack, counts), slices_ = 0;
  pair.walk.advance(stack, leaf_pairs_, first_only_ ? first_slice(slices_++) : kSlice, counts);
  if (first_only_ && slices_ >= kPatientSlices) turn_over(stack);
  clock.charge(statistics.hierarchy_seconds);
  statistics.box_tests += counts.box_tests;
  statistics.nodes_built += counts.made.nodes;
  statistics.triangles_sorted += counts.made.triangles;
  statistics.leaf_pairs += leaf_pairs_.size();
  if (leaf_pairs_.empty()) return;

  filtered_.crossing.clear(), filtered_.unsure.clear();
  if (pair.is_self) {
    // Leaves with themselves give each pair of triangles in both orders, and each triangle with itself.
    const auto own = std::partition(leaf_pairs_.begin(), leaf_pairs_.end(), [](const auto& p) { return p.a == p.b; });
    const auto count = static_cast<std::size_t>(own - leaf_pairs_.begin());
    filter_leaf_pairs(pair, std::span(leaf_pairs_).first(count), clock, statistics);
    for (auto* const found : {&filtered_.crossing, &filtered_.unsure})
      std::erase_if(*found, [](const TrianglePair& p) { return p.a >= p.b; });
    filter_leaf_pairs(pair, std::span(leaf_pairs_).subspan(count), clock, statistics);
  } else {
    filter_leaf_pairs(pair, leaf_pairs_, clock, statistics);
  }
  if (filtered_.crossing.empty() && filtered_.unsure.empty()) return;

  contacts_.clear();
  statistics.exact_calls += filtered_.unsure.size();
  if (pair.is_self) decide_neighbours(pair);
  exact::settle(*pair.a.mesh, pair.a.pose, *pair.b.mesh, pair.b.pose, filtered_.unsure, contacts_);
  const auto keep = [&](std::uint32_t a, std::uint32_t b, Kind kind) {
    const bool swapped = pair.is_self ? b < a : pair.swapped;
    keys_.push_back(swapped ? results::contact_key(b, a, kind) : results::contact_key(a, b, kind));
  };
  for (const TrianglePair& crossing : filtered_.crossing) keep(crossing.a, crossing.b, Kind::crossing);
  for (const exact::Contact& contact : contacts_) keep(contact.a, contact.b, contact.kind);
  clock.charge(statistics.exact_seconds);
}

void FastStages::filter_leaf_pairs(const Pair& pair, std::span<const hierarchy::WideLeafPair> leaf_pairs,
                                   StageClock& clock, Statistics& statistics) {
  sweep_.begin(leaf_pairs, pair.walk.relation);
  for (bool done = leaf_pairs.empty(); !done;) {
    stream_.size = 0;
    done = sweep_.fill(stream_);
    clock.charge(statistics.partition_seconds);
    if (stream_.size == 0) break;  // only at the end: reading the clock shows in small queries
    if (pair.is_self) {
      mark_common_corners(*pair.a.mesh, pair.adjacency, stream_);
      narrow::filter_self_pairs(stream_, filtered_);
    } else {
      narrow::filter_pairs(stream_, filtered_);
    }
    clock.charge(statistics.narrow_seconds);
    statistics.element_tests += stream_.size;
    statistics.triangle_pairs += stream_.size;
  }
}

/// Takes pairs with common vertices out of the unsure ones. (What surely crosses does so beyond these: relative
/// interiors meet.)
void FastStages::decide_neighbours(const Pair& pair) {
  std::erase_if(filtered_.unsure, [&](const TrianglePair& triangles) {
    const SelfPair self(pair.a, triangles, pair.adjacency);
    if (!self.are_neighbours()) return false;
    if (const auto kind = self.meet_beyond()) contacts_.push_back({triangles.a, triangles.b, *kind});
    return true;
  });
}

}  // namespace impinge
