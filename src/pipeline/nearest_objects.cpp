// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/nearest_objects.hpp"

#include <algorithm>
#include <cmath>

namespace impinge {

void NearestObjectsSearch::offer(std::uint32_t a, const scene::PlacedObject& of_a, std::uint32_t b,
                                 const scene::PlacedObject& of_b) {
  if (of_a.mesh == nullptr || of_b.mesh == nullptr) return;
  const Vec3 none{0, 0, 0};
  const Vec3 apart = max(max(of_a.box.lo - of_b.box.hi, of_b.box.lo - of_a.box.hi), none);
  const double square = dot(apart, apart);
  if (square > beyond_) return;
  // Less than the gap by more than the roundings of a few operations.
  const double gap = (1 - 0x1p-48) * std::sqrt(square);
  const double wide = norm(of_a.box.hi - of_a.box.lo) + norm(of_b.box.hi - of_b.box.lo);
  widest_ = std::max(widest_, wide);
  // No two points of both boxes are farther apart, and the distance that will be found is off by less than the rest.
  const double most = norm(max(of_a.box.hi - of_b.box.lo, of_b.box.hi - of_a.box.lo));
  // The last covers squares that underflow.
  bound(most + 0x1p-40 * (most + wide) + 0x1p-500);
  gaps_.push_back({gap, a, b});
}

/// Takes in that another pair is no farther apart than this.
void NearestObjectsSearch::bound(double most) {
  mosts_.push_back(most);
  std::push_heap(mosts_.begin(), mosts_.end());
  if (mosts_.size() > count_) {
    std::pop_heap(mosts_.begin(), mosts_.end());
    mosts_.pop_back();
  }
  if (mosts_.size() == count_) set_nearest_most(std::min(nearest_most_, mosts_.front()));
}

/// Most pairs are dropped by the square of their gap alone. Rounding of both squares is covered many times over, and
/// underflow by what is added.
void NearestObjectsSearch::set_nearest_most(double most) {
  nearest_most_ = most;
  beyond_ = (1 + 0x1p-40) * most * most + 0x1p-1000;
}

void NearestObjectsSearch::sort_gaps() {
  std::erase_if(gaps_, [&](const BoxGap& pair) { return pair.gap > nearest_most_; });
  std::sort(gaps_.begin(), gaps_.end(), [](const BoxGap& p, const BoxGap& q) { return p.gap < q.gap; });
}

/// Keeps what has been found among the nearest. Its error tells what passing over others may have cost.
void NearestObjectsSearch::keep(const NearestObjects& found) {
  const auto farther = [](const NearestObjects& p, const NearestObjects& q) {
    return p.pair.distance < q.pair.distance;
  };
  const auto place = best_.insert(std::upper_bound(best_.begin(), best_.end(), found, farther), found);
  if (found.pair.distance > 0) place->pair.error = std::max(found.pair.error, margin(found.pair.distance));
  if (best_.size() > count_) best_.pop_back();
}

void NearestObjectsSearch::restart() {
  gaps_.clear(), mosts_.clear();
  set_nearest_most(within_);
  widest_ = 0;
}

/// A pair that was passed over may be nearer by its own rounding, 2^-46 of the extent of two triangles and their
/// distance (measure/triangle_distance.cpp).
double NearestObjectsSearch::margin(double distance) const { return 0x1p-45 * (distance + widest_); }

ObjectDistance object_distance(const NearestObjects& found) {
  const auto& [a, b, pair] = found;
  if (a < b) return {{a, b}, {pair.distance, pair.error, pair.a, pair.b, pair.triangle_a, pair.triangle_b}};
  return {{b, a}, {pair.distance, pair.error, pair.b, pair.a, pair.triangle_b, pair.triangle_a}};
}

Result<void> validate_limits(const MeasureOptions& options) {
  if (options.stop_above >= 0 && options.enough_below >= 0) return {};
  return Error{Code::bad_option, "a limit of distance is a number that is not negative"};
}

}  // namespace impinge
