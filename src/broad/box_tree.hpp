// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/shapes.hpp"

namespace impinge::broad {

inline constexpr int kTreeWidth = 8;
inline constexpr std::uint32_t kObjectBit = 0x80000000;  ///< in a lane: an object, not a node
inline constexpr std::uint32_t kNothing = 0xFFFFFFFF;

inline bool contains(const Box& outer, const Box& inner) {
  return outer.lo.x <= inner.lo.x && outer.lo.y <= inner.lo.y && outer.lo.z <= inner.lo.z && inner.hi.x <= outer.hi.x &&
         inner.hi.y <= outer.hi.y && inner.hi.z <= outer.hi.z;
}

/// Eight boxes, of objects and of nodes below. A lane that holds nothing has a box that overlaps none.
struct alignas(64) BoxNode {
  double lo[3][kTreeWidth], hi[3][kTreeWidth];
  std::uint32_t child[kTreeWidth];  ///< an object and kObjectBit, a node's index, or kNothing
  Box bounds;                       ///< holds the eight
  std::uint32_t parent;             ///< kNothing of the root
  std::uint32_t lane;               ///< of this node in its parent

  [[nodiscard]] Box box(int i) const { return {{lo[0][i], lo[1][i], lo[2][i]}, {hi[0][i], hi[1][i], hi[2][i]}}; }
  void set_box(int i, const Box& b) {
    lo[0][i] = b.lo.x, lo[1][i] = b.lo.y, lo[2][i] = b.lo.z;
    hi[0][i] = b.hi.x, hi[1][i] = b.hi.y, hi[2][i] = b.hi.z;
  }
};

/// A bounding-volume tree over objects that are added, removed and moved. Boxes stay in double and are never rounded,
/// so the tree culls as well far from the origin as near it. Objects are numbers below 2^31 - 1.
class BoxTree {
 public:
  /// An object's box with its upper borders negated, so that a union takes the least of each.
  struct Entry {
    Entry(const Box& box, std::uint32_t of)
        : least{box.lo.x, box.lo.y, box.lo.z, -box.hi.x, -box.hi.y, -box.hi.z}, object(of) {}

    std::array<double, 6> least;
    std::uint32_t object;
  };
  /// What a search finds, and its memory, kept for the next.
  struct Search {
    std::vector<std::uint64_t> found;
    std::uint64_t box_tests = 0;  ///< how often a box was held against the eight of a node
    std::vector<std::uint64_t> queue;
  };
  struct Run;

  BoxTree() { clear(); }

  /// Holds these objects and no others. Top-down, by binned surface areas; reorders `entries`.
  void build(std::span<Entry> entries);
  /// Gives an object this box, whether the tree has held it before or not.
  void put(std::uint32_t object, const Box& box);
  /// Forgets an object, if it holds it.
  void remove(std::uint32_t object);
  /// Refits: shrinks the bounds that changes have left too large. Without it they are still conservative.
  void refit();
  /// Whether so much was inserted that building it anew pays.
  [[nodiscard]] bool is_worn() const;

  /// For each of these objects, all those whose boxes in the tree overlap its own in `boxes` (by object), itself among
  /// them: the object asked for in the upper half, the other one in the lower.
  void find(std::span<const std::uint32_t> objects, std::span<const Box> boxes, Search& search) const;
  /// The keys of the pairs whose boxes overlap and whose groups differ or are 0. `boxes`, which are those in the tree,
  /// and `groups` are by object.
  void find_pairs(std::span<const Box> boxes, std::span<const std::uint32_t> groups, Search& search) const;

 private:
  struct Place {
    std::uint32_t node = kNothing, lane = 0;
  };

  void clear();
  std::uint32_t make_node(std::uint32_t parent, int lane);
  void build_node(std::uint32_t node, const Run& run);
  void insert(std::uint32_t object, const Box& box);
  void hold(std::uint32_t node, int lane, std::uint32_t object, const Box& box);
  void set_bounds(std::uint32_t node, const Box& bounds);

  std::vector<BoxNode> nodes_;                   ///< the root first, each after its parent
  std::vector<std::uint8_t> is_dirty_;           ///< by node: it may have shrunk
  std::vector<Place> places_;                    ///< by object
  std::size_t built_objects_ = 0, inserts_ = 0;  ///< when built, and since
};

}  // namespace impinge::broad
