// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "broad/box_tree.hpp"
#include "broad/object_pairs.hpp"
#include "core/for_each.hpp"
#include "scene/scene_view.hpp"

namespace impinge::broad {

struct FindConfig {
  std::stop_token stop{};
  ForEach for_each{};
};

/// The pairs of objects that are near each other, kept from frame to frame.
///
/// Each object has a fat box around its own, with space for the motion that it has shown. While it stays inside, its
/// bounds are written down and that is all. One that has left its fat box gets a new one, which is looked up among
/// the others in a tree. The pairs whose fat boxes overlap are the candidates; a query compares their own bounds.
/// Where much has changed at once, the tree is built anew and walked against itself. A few objects that jump, as the
/// links of a robot do from one configuration to another, are in no tree and in no candidate until they rest: each
/// query looks their own boxes up.
class NearPairs {
 public:
  /// Makes `place` possible for the objects below n, which is at most 2^31 - 1.
  void reserve(std::size_t n);
  /// Writes down where an object is now; without a mesh, or out of range, it is nowhere. Counts from the
  /// next `update` on.
  void place(std::uint32_t object, const scene::PlacedObject& placed) noexcept;
  /// Brings the candidates up to date. If memory runs out, the next call does all the work.
  void update(const ForEach& for_each = {});
  /// Whether an update would change nothing.
  [[nodiscard]] bool is_current() const noexcept { return changed_.empty() && !must_build_; }

  /// Memory of a search, to keep for the next.
  struct Scratch {
    std::vector<std::uint64_t> kept;
    BoxTree::Search jumping;
  };
  /// The pairs whose boxes overlap and whose spheres meet, sorted, without those of one group and the ignored ones. It
  /// must be current. Ends early, with no pairs, when asked to stop. Returns how many pairs it has looked at.
  std::size_t find(const scene::SceneView& view, ObjectPairs& pairs, Scratch& scratch,
                   const FindConfig& config = {}) const;

  /// Looks a box up among the objects' fat boxes, and the boxes of those that jump. `search.found` then holds the
  /// objects. It must be current.
  void find_near(const Box& box, BoxTree::Search& search) const;

  /// Looks boxes[i], for each i of `asked`, up, but not among the objects that jump, which are those of `jumping`.
  /// `search.found` then holds a number for each overlap: i in the upper half, the object in the lower. It must be
  /// current.
  void find_resting(std::span<const std::uint32_t> asked, std::span<const Box> boxes, BoxTree::Search& search) const {
    tree_.find(asked, boxes, search);
  }
  /// At most sixteen.
  [[nodiscard]] std::span<const std::uint32_t> jumping() const { return jumping_; }

  /// How many candidates there are; those of objects that jump are none.
  [[nodiscard]] std::size_t candidates() const { return candidates_.size(); }
  /// How many tests of a box against the eight of a tree's node all updates have made.
  [[nodiscard]] std::uint64_t box_tests() const { return box_tests_; }

 private:
  /// When and where an object's fat box was made, and how many before it lasted for one frame alone.
  struct Start {
    Vec3 twice_middle;
    std::uint32_t frame, short_lived;
  };

  [[nodiscard]] Box fat_box(std::uint32_t object, bool is_new) const;
  void find_jumping();
  void put_back();
  void add_jumping(const scene::SceneView& view, ObjectPairs& pairs, BoxTree::Search& search) const;
  void build();
  void repair(const ForEach& for_each);
  void build_tree();
  void find_fresh(const ForEach& for_each);
  void sort_fresh();
  void merge_fresh();
  std::size_t filter(const scene::SceneView& view, std::size_t begin, std::size_t end, const std::stop_token& stop,
                     std::uint64_t* kept) const;

  std::uint32_t frame_ = 0;
  std::uint32_t population_ = 0;
  bool must_build_ = false;  ///< the last update was cut short
  std::uint64_t box_tests_ = 0;

  // By object.
  std::vector<Sphere> spheres_;
  std::vector<Box> boxes_, fat_boxes_;
  std::vector<Start> starts_;
  std::vector<std::uint32_t> groups_;
  std::vector<std::uint8_t> is_here_, has_changed_, is_jumping_;

  std::vector<std::uint32_t> jumping_;     ///< in no tree and no candidate; a few
  std::vector<std::uint32_t> changed_;     ///< since the last update
  BoxTree tree_;                           ///< of the fat boxes
  std::vector<std::uint64_t> candidates_;  ///< pair keys, sorted

  // An update's scratch. What is in them does not matter.
  std::vector<BoxTree::Search> searches_;
  std::vector<std::uint64_t> fresh_, sorted_, merged_;
  std::vector<std::uint32_t> row_ends_;
  std::vector<BoxTree::Entry> entries_;
};

}  // namespace impinge::broad
