// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
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

/// The least distances of some pairs of objects, pruned over all of them together.
class NearestObjectsSearch {
 public:
  /// Finds `count` pairs, at least 1. Distances above `within` are of no interest, and any below `enough` will do.
  NearestObjectsSearch(std::size_t count, double within, double enough)
      : count_(count), within_(within), enough_(enough) {
    set_nearest_most(within);
  }

  /// Another pair of those that `find` will look at.
  void offer(std::uint32_t a, const scene::PlacedObject& of_a, std::uint32_t b, const scene::PlacedObject& of_b);
  /// Pairs that are farther apart need not be offered.
  [[nodiscard]] double nearest_most() const { return nearest_most_; }
  /// The nearest pairs of those offered, which are forgotten, the nearest first; none that are farther than `within`,
  /// or when asked to stop. `placed(i)` is object i's PlacedMesh. What is returned lives until the next search.
  template <class Placed>
  std::span<const NearestObjects> find(const Placed& placed, const measure::SearchMeans& means) {
    sort_gaps();
    best_.clear();
    double within = nearest_most_;
    for (const auto& [gap, a, b] : gaps_) {
      if (gap > within || means.stop.stop_requested()) break;
      const auto found = measure::nearest_pair(tree_of(placed(a)), tree_of(placed(b)), within, enough_, means);
      if (!found) continue;
      keep({a, b, *found});
      if (best_.size() < count_) continue;
      within = std::min(within, best_.back().pair.distance);
      if (within == 0 || within < enough_) break;
    }
    restart();
    return best_;
  }

 private:
  static hierarchy::PlacedTree tree_of(const PlacedMesh& placed) { return placed.mesh.placed(placed.object.pose); }
  void set_nearest_most(double most);
  void bound(double most);
  void sort_gaps();
  void keep(const NearestObjects& found);
  void restart();
  [[nodiscard]] double margin(double distance) const;

  std::size_t count_;
  double within_, enough_;
  double nearest_most_ = 0;    ///< `count` pairs offered are no farther apart than this, or fewer are of interest
  std::vector<double> mosts_;  ///< the least bounds of the pairs' distances, as many: a heap, the largest on top
  double beyond_ = 0;          ///< a pair whose gap has a greater square is farther apart than that
  double widest_ = 0;          ///< diagonal of a box
  std::vector<BoxGap> gaps_;
  std::vector<NearestObjects> best_;
};

/// The same with the lower object first.
ObjectDistance object_distance(const NearestObjects& found);

/// Errors: `bad_option`.
Result<void> validate_limits(const MeasureOptions& options);

}  // namespace impinge
