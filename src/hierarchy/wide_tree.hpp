// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/for_each.hpp"
#include "core/mesh_data.hpp"
#include "hierarchy/walk_counts.hpp"
#include "hierarchy/wide_leaf.hpp"

/// The fast tree: eight children a node, each node with oriented axes of its own, in single precision about a local
/// origin. Everything is in the tree's unit, 2^unit_exponent() of the mesh's: about the extent of the mesh, so that
/// neither tiny nor huge meshes leave the range of float.
namespace impinge::hierarchy {

inline constexpr int kWidth = 8;
/// Half extent of a lane that holds nothing: no sum with it reaches zero, so every overlap test says no. Finite, so
/// that no product with it is a NaN.
inline constexpr float kNoBox = -1e30f;

struct WideNode;
struct RefitPlan;

/// A node or a leaf, or nothing yet.
class TreeRef {
 public:
  TreeRef() = default;
  explicit TreeRef(std::uintptr_t bits) : bits_(bits) {}
  [[nodiscard]] bool is_made() const { return bits_ != 0; }
  [[nodiscard]] bool is_leaf() const { return (bits_ & kLeafBit) != 0; }
  // NOLINTBEGIN(performance-no-int-to-ptr): a bit of the address says which of the two it is
  [[nodiscard]] WideNode& node() const { return *reinterpret_cast<WideNode*>(bits_); }
  [[nodiscard]] const WideLeaf& leaf() const { return *reinterpret_cast<const WideLeaf*>(bits_ & ~kLeafBit); }
  [[nodiscard]] const void* address() const { return reinterpret_cast<const void*>(bits_ & ~kLeafBit); }
  // NOLINTEND(performance-no-int-to-ptr)
  [[nodiscard]] std::uintptr_t bits() const { return bits_; }
  static constexpr std::uintptr_t kLeafBit = 1;

 private:
  std::uintptr_t bits_ = 0;
};

/// Boxes are {x : |x - center| <= half} in the node's frame and hold the exact local coordinates of every vertex of
/// every triangle below, for certain.
struct alignas(64) WideNode {
  float center[3][kWidth];
  float half[3][kWidth];                      ///< kNoBox in lanes without a child
  std::atomic<std::uintptr_t> child[kWidth];  ///< bits of a TreeRef; see WideTree::child
  Frame frame;
  std::uint32_t size;                          ///< how many children: lanes 0 to size - 1
  std::uint32_t first[kWidth], count[kWidth];  ///< a child's triangles in the tree's order
  // For its children's making alone.
  std::uint32_t depth;
  Vec3 base;  ///< of the soup triangles below
  // For refitting alone.
  std::uint32_t planned;  ///< its number in the plan it was refitted by; kNotPlanned if it was not
  /// How good its triangles' split was when it was made; of a refitted one, how many times worse that and those above
  /// have become since.
  float cost;
  static constexpr std::uint32_t kNotPlanned = ~0u;
};

inline const Frame& frame_of(const TreeRef& ref) { return ref.is_leaf() ? ref.leaf().frame : ref.node().frame; }

/// Top-down, by binned cuts of least surface, or refitted to what a mesh has become, by a plan of the tree that it had
/// once. A node's children are made when a walk first reaches them, and stay; many walks may do so at once, and the
/// tree is the same in whatever order they do. Needs the mesh to outlive it.
class WideTree {
 public:
  /// With a plan the mesh has the triangles that it was made from. Parts where refitting leaves a loose tree are split
  /// anew.
  WideTree(const MeshData& mesh, std::uint32_t leaf_size, std::shared_ptr<const RefitPlan> plan = {});
  ~WideTree();
  WideTree(const WideTree&) = delete;
  WideTree& operator=(const WideTree&) = delete;

  /// The root, made now if need be (`made` counts each node or leaf made). The mesh has at least one
  /// triangle. If memory runs out, here or below, the exception passes and the tree is as it was.
  TreeRef root(MadeNodes& made, const ForEach& for_each = {});

  /// The child in a lane, made now if need be.
  TreeRef child(WideNode& node, int lane, MadeNodes& made, const ForEach& for_each = {}) {
    const TreeRef known(node.child[lane].load(std::memory_order_acquire));
    return known.bits() > kBusy ? known : make_child(node, lane, made, for_each);
  }

  /// Whether any of it is made.
  [[nodiscard]] bool has_root() const;
  /// Makes all that is not made yet.
  void build(const ForEach& for_each = {});
  /// For trees of the same triangles with other vertices: its own plan, unless too much of it is loose by now; else one
  /// of this tree, if at least this share of it is made, from 0 to 1; the rest is made then. Else none.
  std::shared_ptr<const RefitPlan> plan(double least_share = 0, const ForEach& for_each = {});

  [[nodiscard]] int unit_exponent() const;
  /// What the tree holds in memory now.
  [[nodiscard]] std::size_t bytes() const;

 private:
  static constexpr std::uintptr_t kBusy = 2;  ///< in `child`: another walk is making it
  TreeRef make_child(WideNode& node, int lane, MadeNodes& made, const ForEach& for_each);
  void build_below(const TreeRef& top);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace impinge::hierarchy
