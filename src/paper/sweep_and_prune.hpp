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

/// The sorted borders of the objects' projections on X, Y and Z (section 3.2 of the paper). A projection is that of the
/// bounding sphere, cut with that of the posed box, which is tighter for long thin things.
class SweepAndPrune {
 public:
  /// Brings the borders up to date with the scene. They stay sorted between frames, so after slow motion they are
  /// repaired by insertion in nearly linear time; after a jump they are sorted anew.
  void update(const scene::SceneView& view);

  /// The pairs whose projections overlap on all three axes and whose spheres meet. The borders must be up to date. Ends
  /// early, with no pairs, when asked to stop. `comparisons`, if given, is raised by the pairs of objects that were
  /// held against each other.
  [[nodiscard]] broad::ObjectPairs find(const scene::SceneView& view, const std::stop_token& stop = {},
                                        std::uint64_t* comparisons = nullptr) const;

 private:
  std::array<std::vector<Border>, 3> axes_;
};

}  // namespace impinge::paper
