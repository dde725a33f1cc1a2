// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/nearest_objects.hpp"

#include <algorithm>

namespace impinge {

void NearestObjectsSearch::offer(std::uint32_t a, const scene::PlacedObject& of_a, std::uint32_t b,
                                 const scene::PlacedObject& of_b) {
  if (of_a.mesh == nullptr || of_b.mesh == nullptr) return;
  const Vec3 none{0, 0, 0};
  // Less than the gap by more than the roundings of a few operations.
  const double gap = (1 - 0x1p-48) * norm(max(max(of_a.box.lo - of_b.box.hi, of_b.box.lo - of_a.box.hi), none));
  if (!(gap <= nearest_most_)) return;
  const double wide = norm(of_a.box.hi - of_a.box.lo) + norm(of_b.box.hi - of_b.box.lo);
  widest_ = std::max(widest_, wide);
  // No two points of both boxes are farther apart, and the distance that will be found is off by less than the rest.
  const double most = norm(max(of_a.box.hi - of_b.box.lo, of_b.box.hi - of_a.box.lo));
  nearest_most_ = std::min(nearest_most_, most + 0x1p-40 * (most + wide));
  gaps_.push_back({gap, a, b});
}

void NearestObjectsSearch::sort_gaps() {
  std::erase_if(gaps_, [&](const BoxGap& pair) { return pair.gap > nearest_most_; });
  std::sort(gaps_.begin(), gaps_.end(), [](const BoxGap& p, const BoxGap& q) { return p.gap < q.gap; });
}

void NearestObjectsSearch::restart() {
  gaps_.clear();
  nearest_most_ = within_, widest_ = 0;
}

/// A pair that was passed over may be nearer by its own rounding, 2^-46 of the extent of two triangles and their
/// distance (measure/triangle_distance.cpp).
double NearestObjectsSearch::margin(double distance) const { return 0x1p-45 * (distance + widest_); }

std::optional<ObjectDistance> object_distance(const std::optional<NearestObjects>& found) {
  if (!found) return std::nullopt;
  const auto& [a, b, pair] = *found;
  if (a < b)
    return ObjectDistance{{a, b}, {pair.distance, pair.error, pair.a, pair.b, pair.triangle_a, pair.triangle_b}};
  return ObjectDistance{{b, a}, {pair.distance, pair.error, pair.b, pair.a, pair.triangle_b, pair.triangle_a}};
}

Result<void> validate_limits(const MeasureOptions& options) {
  if (options.stop_above >= 0 && options.enough_below >= 0) return {};
  return Error{Code::bad_option, "a limit of distance is a number that is not negative"};
}

}  // namespace impinge
