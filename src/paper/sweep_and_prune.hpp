// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "broad/object_pairs.hpp"
#include "scene/scene_view.hpp"

namespace impinge::paper {

/// One end of an object's projection on an axis.
struct Border {
  double value;
  std::uint32_t object;
  bool is_end;
};

/// The sorted borders of the objects' projections on X, Y and Z (section 3.2 of the paper), kept from query to query. A
/// projection is that of the bounding sphere, cut with that of the posed box, which is tighter for long thin things.
class SweepAndPrune {
 public:
  /// What the last `update` did, and the searches since then.
  struct Counts {
    std::uint64_t updated = 0;       ///< objects whose borders were written
    std::uint64_t moves = 0;         ///< of a border past another one; sorting n anew counts as n log2 n
    std::uint64_t sphere_tests = 0;  ///< pairs of objects, open at once on the sweep's axis, whose bounds were compared
  };

  /// Brings the borders up to date with the scene. They stay sorted between frames, so after slow motion they are
  /// repaired by insertion in a time linear in the moves; after a jump they are sorted anew.
  void update(const scene::SceneView& view);

  /// Writes down the pairs whose projections overlap on all three axes and whose spheres meet. The borders must be up
  /// to date. Ends early, with no pairs, when asked to stop.
  void find(const scene::SceneView& view, broad::ObjectPairs& pairs, const std::stop_token& stop = {});

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  /// An object whose projection on the sweep's axis holds its present position.
  struct Open {
    Box box;
    std::uint32_t object;
  };

  void sort(std::vector<Border>& borders);

  std::array<std::vector<Border>, 3> axes_;
  Counts counts_;
  std::vector<Open> open_;             ///< a search's, in one block of memory
  std::vector<std::uint32_t> places_;  ///< of an open object in open_; of an update: whether its borders are known
};

}  // namespace impinge::paper
