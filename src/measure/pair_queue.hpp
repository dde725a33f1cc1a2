// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "measure/pair_walk.hpp"

namespace impinge::measure {

/// A priority queue of pairs, roughly the nearest first: a stack for each 32nd of the range of distances. An exact
/// order, as a heap keeps it, would take most of the time. Of equally near pairs, as are all whose boxes overlap, the
/// last one pushed comes first: it is the deepest, which keeps the queue short.
class PairQueue {
 public:
  static constexpr std::size_t kStacks = 32;
  using Stacks = std::array<std::vector<NodePair>, kStacks>;

  /// A queue for pairs nearer than `limit`, filled with `pairs`. Clears the stacks and reuses their memory.
  PairQueue(Stacks& stacks, std::span<const NodePair> pairs, double limit) : stacks_(stacks), base_(limit) {
    for (std::vector<NodePair>& stack : stacks_) stack.clear();
    for (const NodePair& pair : pairs) base_ = std::min(base_, pair.lower);
    // Scaled to the whole range, so that neither a tiny nor a huge one over- or underflows.
    per_length_ = limit > base_ ? 1 / (limit - base_) : 0;
    for (const NodePair& pair : pairs) push(pair);
  }

  void push(const NodePair& pair) {
    const double part = (pair.lower - base_) * per_length_ * kStacks;
    const std::size_t i = part > 0 ? static_cast<std::size_t>(std::min(part, kStacks - 1.0)) : 0;
    stacks_[i].push_back(pair);
    first_ = std::min(first_, i);
  }

  /// The next pair, if any is left.
  std::optional<NodePair> pop() {
    while (first_ < kStacks && stacks_[first_].empty()) ++first_;
    if (first_ == kStacks) return std::nullopt;
    const NodePair pair = stacks_[first_].back();
    stacks_[first_].pop_back();
    return pair;
  }

 private:
  Stacks& stacks_;
  std::size_t first_ = 0;  ///< all stacks below it are empty
  double base_, per_length_;
};

/// Memory that a search for the nearest pair leaves for the next one.
struct PairMemory {
  std::vector<NodePair> open, children;
  std::vector<NearTriangles> near;
  PairQueue::Stacks stacks;

  [[nodiscard]] std::size_t pairs_kept() const {
    std::size_t pairs = open.capacity() + children.capacity() + near.capacity();
    for (const std::vector<NodePair>& stack : stacks) pairs += stack.capacity();
    return pairs;
  }
};

/// Tests the triangles of two leaves, roughly the nearest first, as long as they are near: what a test finds may only
/// lessen which are. Most are not after the first test, so the rest is sorted then.
template <class IsNear, class Test>
void nearest_first(std::vector<NearTriangles>& near, const IsNear& is_near, const Test& test) {
  const auto is_nearer = [](const NearTriangles& p, const NearTriangles& q) { return p.lower < q.lower; };
  const auto first = std::min_element(near.begin(), near.end(), is_nearer);
  if (first == near.end() || !is_near(*first)) return;
  const NearTriangles nearest = *first;
  *first = near.back(), near.pop_back();
  test(nearest);
  if (!is_near(nearest)) return;
  std::erase_if(near, [&](const NearTriangles& pair) { return !is_near(pair); });
  std::sort(near.begin(), near.end(), is_nearer);
  for (auto pair = near.begin(); pair != near.end() && is_near(*pair); ++pair) test(*pair);
}

/// Branch and bound over the pairs of two trees: straight down to two leaves, for a first limit, and then roughly the
/// nearest first. `open(pair)` searches two leaves and says true, or replaces `memory.children` by the pairs below and
/// says false; it may lower the limit, beyond which nothing is opened. Ends when `is_done()`; false if it was stopped.
template <class Open, class IsDone>
bool search_pairs(const PairWalk& walk, PairMemory& memory, const double& limit, const std::stop_token& stop,
                  const Open& open, const IsDone& is_done) {
  std::vector<NodePair>& children = memory.children;
  // Of the children the nearest comes last.
  const auto search_or_open = [&](NodePair& pair) {
    if (open(pair)) return true;
    if (!children.empty())
      std::iter_swap(children.end() - 1, std::min_element(children.begin(), children.end(),
                                                          [](auto& p, auto& q) { return p.lower < q.lower; }));
    return false;
  };
  memory.open.clear();
  NodePair down = walk.roots();
  while (!search_or_open(down) && !children.empty()) {
    down = children.back();
    memory.open.insert(memory.open.end(), children.begin(), children.end() - 1);
  }
  std::erase_if(memory.open, [&](const NodePair& pair) { return pair.lower > limit; });
  PairQueue queue(memory.stacks, memory.open, limit);
  while (!is_done()) {
    if (stop.stop_requested()) return false;
    std::optional<NodePair> next = queue.pop();
    if (!next) break;
    if (next->lower > limit || search_or_open(*next)) continue;
    for (const NodePair& child : children) queue.push(child);
  }
  return true;
}

}  // namespace impinge::measure
