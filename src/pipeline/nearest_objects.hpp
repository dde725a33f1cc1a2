// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "impinge/scene.hpp"
#include "measure/nearest.hpp"
#include "pipeline/query.hpp"

namespace impinge {

/// Two objects of a list, and how far apart their boxes are for certain.
struct BoxGap {
  double gap;
  std::uint32_t a, b;
};

struct NearestObjects {
  std::uint32_t a, b;
  measure::NearestPair pair;
};

/// The least distance of some pairs of objects, pruned over all of them together.
class NearestObjectsSearch {
 public:
  /// Distances above `within` are of no interest, and any below `enough` will do.
  NearestObjectsSearch(double within, double enough) : within_(within), enough_(enough) {}

  /// Another pair of those that `find` will look at.
  void offer(std::uint32_t a, const scene::PlacedObject& of_a, std::uint32_t b, const scene::PlacedObject& of_b);
  /// Pairs that are farther apart need not be offered.
  [[nodiscard]] double nearest_most() const { return nearest_most_; }
  /// The nearest pair of those offered, which are forgotten; nothing if all are farther than `within`, or when asked to
  /// stop. `placed(i)` is object i's PlacedMesh.
  template <class Placed>
  std::optional<NearestObjects> find(const Placed& placed, const measure::SearchMeans& means) {
    sort_gaps();
    std::optional<NearestObjects> best;
    double within = nearest_most_;
    for (const auto& [gap, a, b] : gaps_) {
      if (gap > within || means.stop.stop_requested()) break;
      const auto found = measure::nearest_pair(tree_of(placed(a)), tree_of(placed(b)), within, enough_, means);
      if (!found) continue;
      best = {a, b, *found};
      within = found->distance;
      if (within == 0 || within < enough_) break;
    }
    if (best && best->pair.distance > 0) best->pair.error = std::max(best->pair.error, margin(best->pair.distance));
    restart();
    return best;
  }

 private:
  static hierarchy::PlacedTree tree_of(const PlacedMesh& placed) {
    return {placed.object.mesh, &placed.mesh.wide_tree, placed.object.pose};
  }
  void sort_gaps();
  void restart();
  [[nodiscard]] double margin(double distance) const;

  double within_, enough_;
  double nearest_most_ = within_;  ///< some pair offered is no farther apart than this, or none is of interest
  double widest_ = 0;              ///< diagonal of a box
  std::vector<BoxGap> gaps_;
};

/// The same with the lower object first.
std::optional<ObjectDistance> object_distance(const std::optional<NearestObjects>& found);

/// Errors: `bad_option`.
Result<void> validate_limits(const MeasureOptions& options);

}  // namespace impinge
