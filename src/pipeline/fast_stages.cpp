// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/fast_stages.hpp"

#include <algorithm>

#include "exact/settle.hpp"
#include "pipeline/on_threads.hpp"

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

}  // namespace

FastStages::Pair::Pair(const Query& query, const broad::ObjectPair& objects)
    : Pair(query.placed(objects.a), query.placed(objects.b), on_threads(query.options.threads)) {}

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
  sweep_.begin(leaf_pairs_, pair.walk.relation);
  for (bool done = false; !done;) {
    stream_.size = 0;
    done = sweep_.fill(stream_);
    clock.charge(statistics.partition_seconds);
    if (stream_.size == 0) break;  // only at the end: reading the clock shows in small queries
    narrow::filter_pairs(stream_, filtered_);
    clock.charge(statistics.narrow_seconds);
    statistics.element_tests += stream_.size;
    statistics.triangle_pairs += stream_.size;
  }
  if (filtered_.crossing.empty() && filtered_.unsure.empty()) return;

  contacts_.clear();
  statistics.exact_calls += filtered_.unsure.size();
  (pair.is_fine() ? exact::settle_fine : exact::settle)(*pair.a.mesh, pair.a.pose, *pair.b.mesh, pair.b.pose,
                                                        filtered_.unsure, contacts_);
  const auto keep = [&](std::uint32_t a, std::uint32_t b, Kind kind) {
    keys_.push_back(pair.swapped ? results::contact_key(b, a, kind) : results::contact_key(a, b, kind));
  };
  for (const TrianglePair& crossing : filtered_.crossing) keep(crossing.a, crossing.b, Kind::crossing);
  for (const exact::Contact& contact : contacts_) keep(contact.a, contact.b, contact.kind);
  clock.charge(statistics.exact_seconds);
}

}  // namespace impinge
