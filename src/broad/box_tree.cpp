// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/box_tree.hpp"

#include <utility>

#include "broad/box_area.hpp"

namespace impinge::broad {

void BoxTree::clear() {
  nodes_.clear(), is_dirty_.clear(), places_.clear();
  make_node(kNothing, 0);
}

std::uint32_t BoxTree::make_node(std::uint32_t parent, int lane) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  is_dirty_.push_back(0);
  BoxNode& node = nodes_.emplace_back();
  for (int i = 0; i < kTreeWidth; ++i) node.set_box(i, kEmpty), node.child[i] = kNothing;
  node.bounds = kEmpty;
  node.parent = parent, node.lane = static_cast<std::uint32_t>(lane);
  if (parent != kNothing) nodes_[parent].child[lane] = index;
  return index;
}

void BoxTree::hold(std::uint32_t node, int lane, std::uint32_t object, const Box& box) {
  if (object >= places_.size()) places_.resize(object + 1);
  places_[object] = {node, static_cast<std::uint32_t>(lane)};
  nodes_[node].child[lane] = object | kObjectBit;
  nodes_[node].set_box(lane, box);
}

void BoxTree::set_bounds(std::uint32_t index, const Box& bounds) {
  BoxNode& node = nodes_[index];
  node.bounds = bounds;
  if (node.parent != kNothing) nodes_[node.parent].set_box(static_cast<int>(node.lane), bounds);
}

void BoxTree::put(std::uint32_t object, const Box& box) {
  const Place place = object < places_.size() ? places_[object] : Place{};
  if (place.node != kNothing && contains(nodes_[place.node].bounds, box)) {
    nodes_[place.node].set_box(static_cast<int>(place.lane), box);
    is_dirty_[place.node] = 1;
    return;
  }
  remove(object);
  insert(object, box);
}

void BoxTree::remove(std::uint32_t object) {
  if (object >= places_.size() || places_[object].node == kNothing) return;
  const Place place = std::exchange(places_[object], {});
  nodes_[place.node].child[place.lane] = kNothing;
  nodes_[place.node].set_box(static_cast<int>(place.lane), kEmpty);
  is_dirty_[place.node] = 1;
}

/// Descends to the child whose bounds grow least; an emptied node is preferred to all others, as its area counts as
/// infinite. Where a node is full, one of its objects and the new one go into a new node below it.
void BoxTree::insert(std::uint32_t object, const Box& box) {
  ++inserts_;
  for (std::uint32_t index = 0;;) {
    set_bounds(index, united(nodes_[index].bounds, box));
    const BoxNode& node = nodes_[index];
    int best = -1, free = -1;
    double least = kInfinity;
    for (int i = 0; i < kTreeWidth; ++i) {
      const int lane =
          static_cast<int>((object + static_cast<unsigned>(i)) % kTreeWidth);  // ties are spread over the lanes
      if (node.child[lane] == kNothing) {
        free = lane;
        continue;
      }
      const Box other = node.box(lane);
      const double growth = half_area(united(other, box)) - half_area(other);
      if (best < 0 || growth < least) least = growth, best = lane;
    }
    // A free lane is better than a child whose area would more than double.
    const bool fits = best >= 0 && least <= half_area(node.box(best));
    if (best >= 0 && (node.child[best] & kObjectBit) == 0 && (fits || free < 0)) {
      index = node.child[best];
      continue;
    }
    if (free >= 0) return hold(index, free, object, box);
    const std::uint32_t neighbor = node.child[best] & ~kObjectBit;
    const Box neighbor_box = node.box(best);
    const std::uint32_t below = make_node(index, best);
    hold(below, 0, neighbor, neighbor_box);
    hold(below, 1, object, box);
    return set_bounds(below, united(neighbor_box, box));
  }
}

void BoxTree::refit() {
  // A parent comes after all its children.
  for (auto index = static_cast<std::uint32_t>(nodes_.size()); index-- > 0;) {
    if (std::exchange(is_dirty_[index], 0) == 0) continue;
    const BoxNode& node = nodes_[index];
    Box bounds = kEmpty;
    for (int i = 0; i < kTreeWidth; ++i) bounds = united(bounds, node.box(i));
    set_bounds(index, bounds);
    if (node.parent != kNothing) is_dirty_[node.parent] = 1;
  }
}

// An insertion makes at most one node, and nodes are freed only when the tree is built anew: this bounds memory too.
bool BoxTree::is_worn() const { return inserts_ > 2 * built_objects_ + 64; }

}  // namespace impinge::broad
