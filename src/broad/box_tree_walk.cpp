// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "broad/box_tree.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broad/box_tree_walk.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::broad::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using impinge::HWY_NAMESPACE::mask_bits;
using Lanes = hn::CappedTag<double, kTreeWidth>;

/// Which of the eight boxes overlap this one.
HWY_INLINE std::uint32_t overlapping(const BoxNode& node, const Box& box) {
  const Lanes d;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kTreeWidth; i += hn::Lanes(d)) {
    const auto meet = [&](int axis, double lo, double hi) HWY_ATTR {
      return hn::And(hn::Le(hn::Load(d, node.lo[axis] + i), hn::Set(d, hi)),
                     hn::Ge(hn::Load(d, node.hi[axis] + i), hn::Set(d, lo)));
    };
    const auto all =
        hn::And(meet(0, box.lo.x, box.hi.x), hn::And(meet(1, box.lo.y, box.hi.y), meet(2, box.lo.z, box.hi.z)));
    bits |= mask_bits(d, all) << i;
  }
  return bits;
}

HWY_INLINE void prefetch(const BoxNode& node) {
  const auto* bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t i = 0; i < offsetof(BoxNode, bounds); i += 64) hwy::Prefetch(bytes + i);
}

/// Breadth first for many objects at once: a node has time to arrive from memory before its turn comes.
void find(const BoxNode* nodes, std::span<const std::uint32_t> objects, const Box* boxes, BoxTree::Search& search) {
  std::vector<std::uint64_t>&queue = search.queue, &found = search.found;
  queue.clear();
  for (const std::uint32_t object : objects) queue.push_back(std::uint64_t{object} << 32);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint64_t upper = queue[next] & 0xFFFFFFFF00000000;
    const BoxNode& node = nodes[static_cast<std::uint32_t>(queue[next])];
    for (std::uint32_t bits = overlapping(node, boxes[upper >> 32]); bits != 0; bits &= bits - 1) {
      const std::uint32_t child = node.child[std::countr_zero(bits)];
      if ((child & kObjectBit) != 0) {
        found.push_back(upper | (child & ~kObjectBit));
      } else {
        queue.push_back(upper | child);
        prefetch(nodes[child]);
      }
    }
  }
  search.box_tests += queue.size();
}

/// The tree walked against itself: pairs of nodes, of a node and itself, and of an object and a node.
class SelfWalk {
 public:
  SelfWalk(const BoxNode* nodes, const Box* boxes, const std::uint32_t* groups, BoxTree::Search& search)
      : nodes_(nodes), boxes_(boxes), groups_(groups), stack_(search.queue), search_(search) {}

  void run() {
    stack_.assign(1, 0);
    while (!stack_.empty()) {
      const auto first = static_cast<std::uint32_t>(stack_.back() >> 32);
      const auto second = static_cast<std::uint32_t>(stack_.back());
      stack_.pop_back();
      if ((first & kObjectBit) != 0)
        meet(first, boxes_[first & ~kObjectBit], nodes_[second], 0xFF);
      else if (first == second)
        walk_inside(nodes_[first]);
      else
        walk(nodes_[first], nodes_[second]);
    }
  }

 private:
  HWY_INLINE void walk(const BoxNode& a, const BoxNode& b) {
    ++search_.box_tests;
    for (std::uint32_t rows = overlapping(a, b.bounds); rows != 0; rows &= rows - 1) {
      const int row = std::countr_zero(rows);
      meet(a.child[row], a.box(row), b, 0xFF);
    }
  }
  HWY_INLINE void walk_inside(const BoxNode& node) {
    for (int row = 0; row < kTreeWidth; ++row) {
      const std::uint32_t child = node.child[row];
      if (child == kNothing) continue;
      if ((child & kObjectBit) == 0) stack_.push_back(std::uint64_t{child} << 32 | child);
      meet(child, node.box(row), node, 0xFEu << row);
    }
  }
  /// A child of some node, or an object, against the lanes of a node.
  HWY_INLINE void meet(std::uint32_t child, const Box& box, const BoxNode& node, std::uint32_t lanes) {
    ++search_.box_tests;
    for (std::uint32_t bits = overlapping(node, box) & lanes; bits != 0; bits &= bits - 1) {
      const std::uint32_t other = node.child[std::countr_zero(bits)];
      if ((child & other & kObjectBit) != 0)
        add(child & ~kObjectBit, other & ~kObjectBit);
      else if ((other & kObjectBit) != 0)
        stack_.push_back(std::uint64_t{other} << 32 | child);
      else
        stack_.push_back(std::uint64_t{child} << 32 | other);
    }
  }
  HWY_INLINE void add(std::uint32_t a, std::uint32_t b) {
    if (groups_[a] != 0 && groups_[a] == groups_[b]) return;
    search_.found.push_back(a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a);
  }

  const BoxNode* nodes_;
  const Box* boxes_;
  const std::uint32_t* groups_;
  std::vector<std::uint64_t>& stack_;
  BoxTree::Search& search_;
};

void find_pairs(const BoxNode* nodes, const Box* boxes, const std::uint32_t* groups, BoxTree::Search& search) {
  SelfWalk(nodes, boxes, groups, search).run();
}

}  // namespace impinge::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::broad {

HWY_EXPORT(find);
HWY_EXPORT(find_pairs);

void BoxTree::find(std::span<const std::uint32_t> objects, std::span<const Box> boxes, Search& search) const {
  constexpr std::size_t kAtOnce = 64;  // their boxes and their queue stay in cache
  search.found.clear(), search.box_tests = 0;
  for (; !objects.empty(); objects = objects.subspan(std::min(kAtOnce, objects.size())))
    HWY_DYNAMIC_DISPATCH(find)(nodes_.data(), objects.first(std::min(kAtOnce, objects.size())), boxes.data(), search);
}

void BoxTree::find_pairs(std::span<const Box> boxes, std::span<const std::uint32_t> groups, Search& search) const {
  search.found.clear(), search.box_tests = 0;
  HWY_DYNAMIC_DISPATCH(find_pairs)(nodes_.data(), boxes.data(), groups.data(), search);
}

}  // namespace impinge::broad
#endif
