// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "broad/box_tree.hpp"
#include "clash/cells_within.hpp"
#include "clash/sheets/sheets.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {

/// The ends of a part's surface among some sheets of it: edges from which all triangles of the part go the same way.
class SheetEnds {
 public:
  SheetEnds(const solid::Part& part, const Sheets& sheets, const LocalFrame& frame, double tolerance);

  /// Whether the surface ends within a distance of a point; both local.
  [[nodiscard]] bool are_near(const Vec3& point, double distance) const;

 private:
  std::vector<Segment> ends_;  ///< local
  broad::BoxTree tree_;        ///< over them
};

}  // namespace impinge::clash
