// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/fast_stages.hpp"

#include <algorithm>
#include <bit>

#include "exact/settle.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/self_pair.hpp"

namespace impinge {
namespace {

// A slice of work: long enough that clocks and hand-overs do not show, short enough that threads share one large pair.
constexpr hierarchy::WalkLimits kSlice{.leaf_pairs = 512, .box_tests = 65536};

/// A search for one contact begins with a single pair of leaves, the nearest, and takes on twice as much with each
/// slice, up to those of the search for all: it ends soon where contacts abound.
constexpr unsigned kWholeSlice = std::countr_zero(kSlice.leaf_pairs);
hierarchy::WalkLimits first_slice(unsigned number) {
  const std::size_t effort = std::size_t{1} << std::min(number, kWholeSlice);
  return {.leaf_pairs = effort,
          .box_tests = 1024 * effort,
          .at_once = std::min(effort, hierarchy::WalkLimits::kMostAtOnce),
          .nearest_first = number == 0};
}

/// After so many slices without a contact the search leaves the branch that gave none, and again after each that
/// follows.
constexpr unsigned kPatientSlices = 4;

/// The older half, of larger subtrees, comes to the top.
void turn_over(std::vector<hierarchy::TreeRefPair>& stack) {
  std::rotate(stack.begin(), stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2), stack.end());
}

/// `PairStream::common`, without a branch. Of those with all corners in common, which always count, 0.
template <class Corners>
std::uint32_t common_bits(const Corners& a, const Corners& b) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t j = 0; j < 3; ++j) {
      const auto is_same = static_cast<std::uint32_t>(a[i] == b[j]);
      bits |= is_same << i | is_same << (3 + j);
    }
  }
  return bits == 63 ? 0 : bits;
}

/// Vertices of one index are in one place, and so are those of one place in the mesh when they are placed in the world:
/// of what else is common the exact stage knows. Places are compared where no two triangles share an index, unless
/// neighbours are by index alone or one of the triangles has an embedded star's vertex: its neighbours share indices.
void mark_common_corners(const MeshData& mesh, bool by_index, const partition::EmbeddedStars* stars,
                         partition::PairStream& stream) {
  std::uint32_t any = 0;
  for (std::size_t i = 0; i < stream.size; ++i)
    any |= stream.common[i] = common_bits(mesh.triangles[stream.id_a[i]], mesh.triangles[stream.id_b[i]]);
  if (any != 0 || by_index) return;
  const auto corners = [&mesh](std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return Triangle{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
  };
  const auto has_star = [stars](std::uint32_t t) {
    constexpr std::uint32_t kNone = partition::EmbeddedStars::kNone;
    return stars != nullptr && stars->corners[t] != std::array{kNone, kNone, kNone};
  };
  for (std::size_t i = 0; i < stream.size; ++i)
    if (!has_star(stream.id_a[i]) && !has_star(stream.id_b[i]))
      stream.common[i] = common_bits(corners(stream.id_a[i]), corners(stream.id_b[i]));
}

}  // namespace

FastStages::Pair::Pair(const Query& query, const broad::ObjectPair& objects)
    : Pair(query.placed(objects.a), query.placed(objects.b), on_threads(query.options.threads)) {
  is_self = walk.is_self = objects.a == objects.b;
  adjacency = query.options.adjacency;
  if (is_self) own = query.meshes[objects.a], stop = &query.options.stop;
}

FastStages::Pair::Pair(const PlacedMesh& first, const PlacedMesh& second, const ForEach& for_each)
    : swapped(is_swapped(first.mesh, second.mesh)),
      a((swapped ? second : first).object),
      b((swapped ? first : second).object),
      walk{(swapped ? second : first).mesh.wide_tree, (swapped ? first : second).mesh.wide_tree,
           hierarchy::relate(*a.mesh, a.pose, walk.a.unit_exponent(), *b.mesh, b.pose, walk.b.unit_exponent()),
           for_each} {}

bool FastStages::Pair::is_swapped(const MeshState& first, const MeshState& second) {
  return first.wide_tree.unit_exponent() < second.wide_tree.unit_exponent();
}

void FastStages::configure(Options::Find find, std::uint8_t kinds) {
  kinds_ = kinds;
  first_only_ = find == Options::Find::first;
  any_is_enough_ = first_only_ && kinds == kAllKinds;
  looked_at_ = 0;
  keys_.clear();
}

bool FastStages::is_worth_sharing() const { return !first_only_ || slices_ >= kWholeSlice; }
void FastStages::resume() { slices_ = kWholeSlice; }

void FastStages::run_slice(const Pair& pair, bool fresh, std::vector<Step>& stack, StageClock& clock,
                           Statistics& statistics) {
  hierarchy::WalkCounts counts;
  leaf_pairs_.clear(), keys_.clear();
  if (fresh) pair.walk.start(stack, counts), slices_ = 0, looked_at_ = 0;
  pair.walk.advance(stack, leaf_pairs_, first_only_ ? first_slice(slices_++) : kSlice, counts);
  if (first_only_ && slices_ >= kPatientSlices) turn_over(stack);
  clock.charge(statistics.hierarchy_seconds);
  statistics.box_tests += counts.box_tests;
  statistics.nodes_built += counts.made.nodes;
  statistics.triangles_sorted += counts.made.triangles;
  statistics.leaf_pairs += leaf_pairs_.size();
  looked_at_ += leaf_pairs_.size();
  if (leaf_pairs_.empty()) return;

  // Of a search for one contact the nearest leaves, which come last, are looked at by themselves while slices are
  // small.
  const std::span<const hierarchy::WideLeafPair> all(leaf_pairs_);
  const std::size_t nearest = any_is_enough_ && slices_ <= kPatientSlices ? 1 : all.size();
  decide(pair, all.last(nearest), clock, statistics);
  if (keys_.empty() && nearest < all.size()) decide(pair, all.first(all.size() - nearest), clock, statistics);
}

/// Partition to exact.
void FastStages::decide(const Pair& pair, std::span<const hierarchy::WideLeafPair> leaf_pairs, StageClock& clock,
                        Statistics& statistics) {
  filtered_.crossing.clear(), filtered_.unsure.clear();
  const partition::EmbeddedStars* const stars = stars_of(pair);
  sweep_.begin(leaf_pairs, pair.walk.relation, pair.is_self, stars);
  for (bool done = false; !done;) {
    stream_.size = 0;
    done = sweep_.fill(stream_);
    clock.charge(statistics.partition_seconds);
    if (stream_.size == 0) break;  // only at the end: reading the clock shows in small queries
    if (pair.is_self) {
      mark_common_corners(*pair.a.mesh, pair.adjacency == Adjacency::by_index, stars, stream_);
      narrow::filter_self_pairs(stream_, filtered_);
    } else {
      narrow::filter_pairs(stream_, filtered_);
    }
    clock.charge(statistics.narrow_seconds);
    statistics.element_tests += stream_.size;
    statistics.triangle_pairs += stream_.size;
    if (any_is_enough_ && !filtered_.crossing.empty()) {
      filtered_.unsure.clear();
      break;
    }
  }
  if (filtered_.crossing.empty() && filtered_.unsure.empty()) return;

  contacts_.clear();
  statistics.exact_calls += filtered_.unsure.size();
  if (pair.is_self) decide_neighbours(pair);
  (pair.is_outside_exact_domain() ? exact::settle_one_by_one : exact::settle)(*pair.a.mesh, pair.a.pose, *pair.b.mesh,
                                                                              pair.b.pose, filtered_.unsure, contacts_);
  const auto keep = [&](std::uint32_t a, std::uint32_t b, Kind kind) {
    if ((kinds_ >> static_cast<int>(kind) & 1) == 0) return;
    const bool swapped = pair.is_self ? b < a : pair.swapped;
    keys_.push_back(swapped ? results::contact_key(b, a, kind) : results::contact_key(a, b, kind));
  };
  for (const TrianglePair& crossing : filtered_.crossing) keep(crossing.a, crossing.b, Kind::crossing);
  for (const exact::Contact& contact : contacts_) keep(contact.a, contact.b, contact.kind);
  clock.charge(statistics.exact_seconds);
}

/// The stars that stay embedded in the world; null: none do. To look for them takes about as long as to look at all
/// triangles: a search for one contact does so only after as many.
//
// The world's vertices are R (x + d) + t with R d at most the rounding: d is at most sqrt 3 times as much, and as much
// as R may be longer or shorter than a rotation. An affine map leaves what is embedded so.
const partition::EmbeddedStars* FastStages::stars_of(const Pair& pair) const {
  if (!pair.is_self) return nullptr;
  const MeshState& own = *pair.own;
  const bool is_early = first_only_ && looked_at_ * MeshState::kWideLeafSize < own.data.triangles.size();
  if (is_early && own.stars.known() == nullptr) return nullptr;
  const partition::EmbeddedStars& stars = own.stars.of(own.data, *own.closed, pair.walk.for_each, *pair.stop);
  const double moved = 1.8 * max_component(rounding_radius(pair.a.pose, own.data));
  return !stars.corners.empty() && moved <= stars.slack ? &stars : nullptr;
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
