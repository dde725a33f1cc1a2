// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/wide_tree.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "hierarchy/arena.hpp"
#include "hierarchy/make_leaf.hpp"
#include "hierarchy/refit_node.hpp"
#include "hierarchy/refit_plan.hpp"
#include "hierarchy/round_up.hpp"
#include "hierarchy/triangle_soup.hpp"
#include "hierarchy/wide_split.hpp"

namespace impinge::hierarchy {
namespace {

/// Below this depth ranges are cut by count, so the depth is at most this and log8 of the triangles, even where each
/// split peels off a few triangles.
constexpr std::uint32_t kDeepestPlannedSplit = 20;
/// When a range has shrunk to this part of its distance from the soup's base, it gets a base of its own.
constexpr double kShrunk = 0x1p-10;
/// In a full build, below ranges of this size one thread does it all.
constexpr std::uint32_t kLarge = 1 << 12;
constexpr std::size_t kChunk = std::size_t{1} << 15;

/// So that the extent is between 1/2 and 1 in the unit. 2^-k v is exact unless it falls below 2^-1074 there, which is
/// nothing (kNothing). Nor does it overflow: coordinates in range are below 2^300, and while they are multiples of
/// 2^-358 the extent, if any, is at least 2^-658 of the largest. A lesser one counts as 2^-700 of it: floating point
/// then tells nothing of the mesh's own shape, and exact arithmetic has the work.
int unit_exponent_of(const MeshData& mesh) {
  const double largest = max_component(mesh.max_abs);
  if (largest == 0) return 0;
  const double half_extent = max_component(0.5 * mesh.box.hi - 0.5 * mesh.box.lo);
  const int of_size = exponent(largest) + 1;
  const int of_extent = half_extent > 0 ? exponent(half_extent) + 2 : of_size;
  return std::clamp(of_extent, std::max(of_size - 700, -1000), 1026);
}

/// How far from exact a coordinate of a node's boxes may be, for triangles whose box reaches `reach` from the node's
/// origin, which lies `center` from the soup's base, in the largest coordinate. With u = 2^-24: s - c is off by
/// u (|s| + |c| + |s - c|) <= u (2 |c| + 2 |d|) per coordinate, by the rounding of s, of c and of the difference d. The
/// rotation's three products and two sums add 3 u times the sum of |F_il| |d_l|, that sum being at most sqrt(3) |d|.
/// Together that is less than sqrt(3) u (2 |c| + 5 |d|), and |d| <= sqrt(3) reach but for less than a thousandth.
double slack(double center, double reach) { return 0x1p-24 * (4 * center + 16 * reach) + kNothing; }

/// Refitted triangles are split anew where they cost more than so many times what they did; a plan is given up when so
/// much of a tree was.
constexpr float kLoose = 2;
constexpr double kGivenUp = 1 / 8.0;

float half_surface(float x, float y, float z) { return x * y + y * z + z * x; }

TreeRef ref_to(const WideLeaf* leaf) { return TreeRef(reinterpret_cast<std::uintptr_t>(leaf) | TreeRef::kLeafBit); }
TreeRef ref_to(const WideNode* node) { return TreeRef(reinterpret_cast<std::uintptr_t>(node)); }

/// The surface of the children's boxes, by their triangles, in that of the box around all: how much of what meets the
/// node meets a triangle's box below it.
float surface_cost(const WideNode& node) {
  float lo[3] = {-kNoBox, -kNoBox, -kNoBox}, hi[3] = {kNoBox, kNoBox, kNoBox}, sum = 0, triangles = 0;
  for (std::uint32_t lane = 0; lane < node.size; ++lane) {
    const auto count = static_cast<float>(node.count[lane]);
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], node.center[i][lane] - node.half[i][lane]);
      hi[i] = std::max(hi[i], node.center[i][lane] + node.half[i][lane]);
    }
    sum += 4 * half_surface(node.half[0][lane], node.half[1][lane], node.half[2][lane]) * count;
    triangles += count;
  }
  const float whole = half_surface(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
  return whole == 0 ? 0 : sum / (whole * triangles);
}

}  // namespace

struct WideTree::State {
  /// Triangles that become a node or a leaf.
  struct Range {
    Vec3 base;
    std::uint32_t first, count, depth;
    bool needs_base;  ///< one of its own, before anything else
  };

  State(const MeshData& numbers, std::uint32_t most_in_leaf, std::shared_ptr<const RefitPlan> plan_of_other)
      : plan(std::move(plan_of_other)),
        plan_bytes(plan ? plan->bytes() : 0),
        leaf_size(most_in_leaf),
        unit_exponent(unit_exponent_of(numbers)),
        source{numbers, std::ldexp(1.0, -unit_exponent)},
        not_in_leaves(numbers.triangles.size()) {}

  const std::shared_ptr<const RefitPlan> plan;
  std::shared_ptr<const RefitPlan> own_plan;
  std::once_flag own_plan_once;
  std::atomic<std::size_t> plan_bytes;
  const std::uint32_t leaf_size;
  const int unit_exponent;
  const SoupSource source;
  Arena arena;
  std::atomic<std::uintptr_t> root{0};
  Vec3 base{};
  std::unique_ptr<SoupTriangle[]> soup;
  std::once_flag soup_once;
  std::atomic<std::size_t> soup_size{0};
  std::atomic<std::size_t> not_in_leaves;
  std::atomic<std::size_t> loose{0};  ///< triangles that were planned and are split anew

  TreeRef make_root(const ForEach& for_each);
  TreeRef make(Range range, const ForEach& for_each);
  TreeRef make_node(const Range& range, std::span<SoupTriangle> triangles, const ForEach& for_each);
  TreeRef refit(std::uint32_t number, bool is_leaf, float growth, const ForEach& for_each);
  TreeRef make_planned(const WideNode& node, int lane, const ForEach& for_each);
  void make_soup();
  void count_leaf(std::size_t triangles);
  Range range_of(const WideNode& node, int lane) const;

  template <class Make>
  TreeRef make_once(std::atomic<std::uintptr_t>& slot, std::size_t triangles, MadeNodes& made, const Make& make);
};

/// Lets one thread make what a slot holds; the others wait for it.
template <class Make>
TreeRef WideTree::State::make_once(std::atomic<std::uintptr_t>& slot, std::size_t triangles, MadeNodes& made,
                                   const Make& make) {
  const auto settle = [&](std::uintptr_t bits) {
    slot.store(bits, std::memory_order_release);
    slot.notify_all();
  };
  std::uintptr_t bits = slot.load(std::memory_order_acquire);
  while (bits <= kBusy) {
    if (bits == kBusy) {  // another walk is making it
      slot.wait(kBusy, std::memory_order_acquire);
      bits = slot.load(std::memory_order_acquire);
    } else if (slot.compare_exchange_weak(bits, kBusy, std::memory_order_acquire)) {
      try {
        bits = make().bits();
      } catch (...) {  // out of memory: whoever waits, or comes later, may try again
        settle(0);
        throw;
      }
      ++made.nodes, made.triangles += triangles;
      settle(bits);
    }
  }
  return TreeRef(bits);
}

void WideTree::State::make_soup() {
  std::call_once(soup_once, [&] {
    soup = std::make_unique_for_overwrite<SoupTriangle[]>(source.mesh.triangles.size());
    soup_size = source.mesh.triangles.size();
  });
}

TreeRef WideTree::State::make_root(const ForEach& for_each) {
  if (plan) {
    if (const TreeRef refitted = refit(0, plan->nodes.empty(), 1, for_each); refitted.is_made()) return refitted;
  }
  const std::size_t n = source.mesh.triangles.size();
  make_soup();
  base = choose_base(source, n, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
  run_each(for_each, (n + kChunk - 1) / kChunk, [&](std::size_t c) {
    const std::size_t begin = c * kChunk, end = std::min(begin + kChunk, n);
    for (std::size_t i = begin; i < end; ++i) soup[i].id = static_cast<std::uint32_t>(i);
    write_corners(source, base, {soup.get() + begin, end - begin});
  });
  return make({base, 0, static_cast<std::uint32_t>(n), 0, false}, for_each);
}

WideTree::State::Range WideTree::State::range_of(const WideNode& node, int lane) const {
  const Vec3 from_base = Vec3{node.frame.origin[0], node.frame.origin[1], node.frame.origin[2]} - node.base;
  double extent = 0, reach = 0;
  for (int i = 0; i < 3; ++i) {
    extent = std::max<double>(extent, node.half[i][lane]);
    reach = std::max<double>(reach, std::abs(node.center[i][lane]) + node.half[i][lane]);
  }
  const double distance = max_component(abs(from_base)) + 2 * reach;
  return {node.base, node.first[lane], node.count[lane], node.depth + 1u, extent < kShrunk * distance};
}

TreeRef WideTree::State::make(Range range, const ForEach& for_each) {
  const std::span triangles(soup.get() + range.first, range.count);
  if (range.needs_base) {
    range.base = choose_base(source, range.count, [&](std::size_t i) { return triangles[i].id; });
    write_corners(source, range.base, triangles);
  }
  if (range.count > leaf_size) return make_node(range, triangles, for_each);
  const WideLeaf* const leaf = make_leaf(triangles, range.base, source, arena);
  count_leaf(range.count);
  return ref_to(leaf);
}

void WideTree::State::count_leaf(std::size_t triangles) {
  if (not_in_leaves.fetch_sub(triangles) != triangles) return;
  soup.reset();  // nobody reads it any more
  soup_size = 0;
}

TreeRef WideTree::State::make_node(const Range& range, std::span<SoupTriangle> triangles, const ForEach& for_each) {
  auto* const node = new (arena.allocate(sizeof(WideNode))) WideNode;
  const WideSplit parts = split(
      triangles, {.base = range.base, .leaf_size = leaf_size, .halve = range.depth >= kDeepestPlannedSplit}, for_each);
  const SoupFrame& frame = parts.frame;
  node->base = range.base;
  node->depth = range.depth, node->planned = WideNode::kNotPlanned;
  node->size = parts.size;
  double center = 0, radius = 0;
  const double bases[3] = {range.base.x, range.base.y, range.base.z};
  for (int l = 0; l < 3; ++l) {
    node->frame.origin[l] = bases[l] + double{frame.center[l]};
    std::copy(frame.axes[l], frame.axes[l] + 4, node->frame.axes[l]);
    center = std::max(center, std::abs(double{frame.center[l]}));
  }
  node->frame.origin[3] = 0;
  std::uint32_t first = range.first;
  for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
    node->child[lane].store(0, std::memory_order_relaxed);
    const bool is_used = lane < parts.size;
    node->first[lane] = first;
    node->count[lane] = is_used ? parts.count[lane] : 0;
    first += node->count[lane];
    double lo[3], hi[3], reach = 0;
    for (int i = 0; i < 3; ++i) {
      lo[i] = is_used ? double{parts.lo[lane][i]} / frame.scale : 0;
      hi[i] = is_used ? double{parts.hi[lane][i]} / frame.scale : 0;
      reach = std::max({reach, -lo[i], hi[i]});
    }
    const double margin = slack(center, reach);
    for (int i = 0; i < 3; ++i) {
      const float middle = static_cast<float>(0.5 * (lo[i] + hi[i]));
      node->center[i][lane] = middle;
      node->half[i][lane] = is_used ? round_up(std::max(hi[i] - middle, middle - lo[i]) + margin) : kNoBox;
    }
    if (is_used) radius = std::max(radius, reach + margin);
  }
  node->frame.radius = round_up(radius);
  node->cost = surface_cost(*node);
  return ref_to(node);
}

/// Nothing if that would be loose. `growth` says how much worse the splits above have become.
TreeRef WideTree::State::refit(std::uint32_t number, bool is_leaf, float growth, const ForEach& for_each) {
  if (is_leaf) {
    const RefitPlan::Leaf& planned = plan->leaves[number];
    const WideLeaf* const leaf = refit_leaf(*plan, planned, source, arena);
    count_leaf(planned.count);
    return ref_to(leaf);
  }
  const RefitPlan::Node& planned = plan->nodes[number];
  auto* const node = new (arena.allocate(sizeof(WideNode))) WideNode;
  refit_node(*plan, planned, source, *node, for_each);
  const float cost = surface_cost(*node);
  node->planned = number;
  node->cost = growth * (cost == 0 ? 1 : cost / planned.split_cost);  // infinite where it was flat, and is no more
  if (node->cost <= kLoose) return ref_to(node);                      // not if it is a NaN
  loose += std::accumulate(planned.count, planned.count + planned.size, std::size_t{0});
  return {};
}

TreeRef WideTree::State::make_planned(const WideNode& node, int lane, const ForEach& for_each) {
  const RefitPlan::Node& planned = plan->nodes[node.planned];
  const TreeRef refitted = refit(planned.child[lane], planned.is_leaf[lane], node.cost, for_each);
  if (refitted.is_made()) return refitted;
  make_soup();
  const Range range{{}, node.first[lane], node.count[lane], node.depth + 1u, true};
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) soup[i].id = plan->order[i];
  return make(range, for_each);
}

WideTree::WideTree(const MeshData& mesh, std::uint32_t leaf_size, std::shared_ptr<const RefitPlan> plan)
    : state_(std::make_unique<State>(mesh, leaf_size, std::move(plan))) {}
WideTree::~WideTree() = default;

bool WideTree::has_root() const { return state_->root.load(std::memory_order_acquire) > kBusy; }

TreeRef WideTree::root(MadeNodes& made, const ForEach& for_each) {
  return state_->make_once(state_->root, state_->source.mesh.triangles.size(), made,
                           [&] { return state_->make_root(for_each); });
}

TreeRef WideTree::make_child(WideNode& node, int lane, MadeNodes& made, const ForEach& for_each) {
  return state_->make_once(node.child[lane], node.count[lane], made, [&] {
    return node.planned == WideNode::kNotPlanned ? state_->make(state_->range_of(node, lane), for_each)
                                                 : state_->make_planned(node, lane, for_each);
  });
}

void WideTree::build_below(const TreeRef& top) {
  MadeNodes made;
  std::vector<TreeRef> open{top};
  while (!open.empty()) {
    const TreeRef next = open.back();
    open.pop_back();
    if (next.is_leaf()) continue;
    for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
      open.push_back(child(next.node(), static_cast<int>(lane), made));
  }
}

void WideTree::build(const ForEach& for_each) {
  struct Slot {
    WideNode* node;
    int lane;
    [[nodiscard]] std::uint32_t count() const { return node->count[lane]; }
  };
  const auto largest_first = [](const Slot& p, const Slot& q) { return p.count() > q.count(); };
  MadeNodes made;
  const TreeRef top = root(made, for_each);
  if (top.is_leaf()) return;
  // Level by level until there is work for many threads, then below each node by itself.
  const std::uint32_t large = std::max(kLarge, static_cast<std::uint32_t>(state_->source.mesh.triangles.size() / 256));
  std::vector<Slot> level, small;
  const auto open = [&](WideNode& node) {
    for (int lane = 0; lane < static_cast<int>(node.size); ++lane)
      (node.count[lane] > large ? level : small).push_back({&node, lane});
  };
  open(top.node());
  while (!level.empty()) {
    std::sort(level.begin(), level.end(), largest_first);
    run_each(for_each, level.size(), [&](std::size_t i) {
      MadeNodes own;
      child(*level[i].node, level[i].lane, own, for_each);
    });
    for (const Slot& slot : std::exchange(level, {})) open(child(*slot.node, slot.lane, made).node());
  }
  std::sort(small.begin(), small.end(), largest_first);
  run_each(for_each, small.size(), [&](std::size_t i) {
    MadeNodes own;
    build_below(child(*small[i].node, small[i].lane, own));
  });
}

std::shared_ptr<const RefitPlan> WideTree::plan(double least_share, const ForEach& for_each) {
  State& s = *state_;
  const auto all = static_cast<double>(s.source.mesh.triangles.size());
  if (s.plan && static_cast<double>(s.loose.load()) <= kGivenUp * all) return s.plan;
  if (all == 0 || all - static_cast<double>(s.not_in_leaves.load()) < least_share * all) return nullptr;
  std::call_once(s.own_plan_once, [&] {
    // The last leaves may be counted and not yet in their slots: `build` waits for them. Threads are for what is not
    // made.
    build(s.not_in_leaves.load() > 0 ? for_each : ForEach());
    s.own_plan = make_refit_plan(TreeRef(s.root.load(std::memory_order_acquire)), s.source, s.plan.get());
    if (s.own_plan) s.plan_bytes += s.own_plan->bytes();
  });
  return s.own_plan;
}

int WideTree::unit_exponent() const { return state_->unit_exponent; }

std::size_t WideTree::bytes() const {
  return sizeof(WideTree) + sizeof(State) + state_->plan_bytes + state_->arena.bytes() +
         state_->soup_size * sizeof(SoupTriangle);
}

}  // namespace impinge::hierarchy
