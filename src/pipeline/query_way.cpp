// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/query_way.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "schedule/cost.hpp"
#include "schedule/parallel.hpp"
#include "schedule/split.hpp"

namespace impinge {
namespace {

using schedule::Way;

// Short queries are left to the CPU until a device is open and calibrated, and then too those that end before a device
// would answer. So many kinds of them are remembered. A node takes as long to make as so many tests of boxes at most.
constexpr double kShort = 1e-3, kSoonerThanAnyDevice = 1e-4;
constexpr std::size_t kMostKinds = 64;
constexpr std::uint64_t kBoxTestsForANode = 1000;
/// Of what both sides' speeds ask for, what the device is given from the beginning.
constexpr double kFirstShare = 0.85;

/// A hash of what decides how long a query takes. Queries have the same kind if they ask the same, have as many pairs
/// and as many triangles in the first pair (up to a factor of 2), and if both or neither must make that pair's trees.
std::uint64_t kind_of(const Query& query, const broad::ObjectPairs& pairs, bool makes_trees) {
  const Options& options = query.options;
  const auto size = [](std::size_t n) { return static_cast<std::uint64_t>(std::bit_width(n)); };
  const auto triangles = [&](std::uint32_t object) { return size(query.meshes[object]->data.triangles.size()); };
  std::uint64_t kind = (options.find == Options::Find::first ? 1 : 0) + (makes_trees ? 2 : 0);
  for (const std::uint64_t next : {std::uint64_t{options.kinds}, static_cast<std::uint64_t>(options.threads),
                                   size(pairs.size()), triangles(pairs[0].a), triangles(pairs[0].b)})
    kind = kind << 10 ^ next;
  return kind ^ std::hash<std::string_view>()(options.device);
}

}  // namespace

void QueryWay::choose(const Query& query, const broad::ObjectPairs& pairs, Workspace::State& memory) {
  way_ = query.options.backend == "gpu" ? Way::device : Way::both;
  if (way_ == Way::device || query.options.device_share >= 0 || pairs.empty()) return;
  const auto has_tree = [&](std::uint32_t object) { return query.meshes[object]->wide_tree.has_root(); };
  makes_trees_ = !has_tree(pairs[0].a) && !has_tree(pairs[0].b);
  const std::uint64_t kind = kind_of(query, pairs, makes_trees_);
  if (memory.ways.size() >= kMostKinds && !memory.ways.contains(kind)) memory.ways.clear();
  ways_ = &memory.ways[kind];
  since_choice_ = StageClock();
  std::optional<KnownConstants> known;
  if (memory.device != nullptr) known = known_constants(memory.device);
  is_device_ready_ = known.has_value();
  if (ways_->is_empty()) return;
  if (ways_->last_seconds() < (known ? kSoonerThanAnyDevice : kShort)) {
    way_ = Way::cpu;
  } else if (known) {
    way_ = quickest(*known, query.options.threads);
  }
}

Way QueryWay::quickest(const KnownConstants& known, int threads) {
  const auto& [device, cpu] = known;
  const Statistics& last = ways_->last();
  schedule::WaySeconds expected{};
  const auto of = [&](Way way) -> double& { return expected[static_cast<std::size_t>(way)]; };
  of(Way::cpu) = schedule::predict_seconds(last, cpu) / schedule::concurrency(threads);
  of(Way::device) = device.question + schedule::predict_device_seconds(last, device) +
                    static_cast<double>(last.exact_calls) * cpu.exact_call;
  // Both end together: a portion is what is needed to make it so.
  const double alone = ways_->seconds(Way::cpu, expected), with_device = ways_->seconds(Way::device, expected);
  const double share =
      schedule::device_portion(1, {1 / alone, 1 / std::max(with_device - device.question, 1e-9), device.question});
  of(Way::both) = share > 0 ? (1 - share) * alone : std::numeric_limits<double>::infinity();
  const Way way = ways_->quickest(expected);
  if (way == Way::both) first_share_ = kFirstShare * std::min(share, 1.0);
  return way;
}

void QueryWay::learn(const Statistics& counts, bool has_brought_meshes) {
  if (ways_ == nullptr) return;
  double seconds = 0;
  since_choice_.charge(seconds);
  // What makes trees and brings meshes is like only what does so too.
  const bool is_alike = !has_brought_meshes && counts.nodes_built * kBoxTestsForANode <= counts.box_tests;
  ways_->add(way_, counts, seconds, (is_device_ready_ || way_ == Way::cpu) && (is_alike || makes_trees_));
}

}  // namespace impinge
