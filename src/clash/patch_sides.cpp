// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/patch_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace impinge::clash {

double reach_of_side(const Winding& winding, double number, const Vec3& point, double within) {
  if (winding.closed) return kInfinity;
  const double ratio = 0.25 / (std::abs(number - std::round(number)) + 0x1p-6);
  const double share = ratio > 1 ? (2 * ratio + 1 - std::sqrt(8 * ratio + 1)) / (2 * ratio) : 0;
  return share > 0 ? share * winding.to_open_edge(point, within / share) : 0;
}

PatchSides::PatchSides(const DepthSearch& search, std::span<const std::uint32_t> candidates)
    : inner_(search.inner), outer_(search.outer), winding_(search.winding), side_(search.inner.size(), Side::touching) {
  for (const std::uint32_t t : candidates) side_[t] = Side::unknown;
  for (const TrianglePair& pair : search.touching) side_[pair.a] = Side::touching;
  list_fans(candidates);
}

std::optional<bool> PatchSides::is_inside(std::uint32_t triangle) {
  if (side_[triangle] == Side::unknown) look_around(triangle);
  if (side_[triangle] == Side::touching || side_[triangle] == Side::unknown) return std::nullopt;
  return side_[triangle] == Side::inside;
}

void PatchSides::list_fans(std::span<const std::uint32_t> candidates) {
  offsets_.assign(inner_.world.size() + 1, 0);
  const auto each_corner = [&](const auto& visit) {
    for (const std::uint32_t t : candidates)
      if (side_[t] == Side::unknown)
        for (const std::uint32_t v : corners(t)) visit(v, t);
  };
  each_corner([&](std::uint32_t v, std::uint32_t) { ++offsets_[v + 1]; });
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  fans_.resize(offsets_.back());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  each_corner([&](std::uint32_t v, std::uint32_t t) { fans_[next[v]++] = t; });
}

/// A closed body has nothing outside of its box, so that most patches need no winding number.
void PatchSides::look_around(std::uint32_t first) {
  const Vec3 middle = inner_.world[corners(first)[0]];
  double winding = winding_.closed ? 0 : winding_.at(middle);
  const double reach = reach_of_side(winding_, winding, middle, kInfinity);
  const auto is_far = [&](std::uint32_t v) { return norm(inner_.world[v] - middle) > reach; };
  patch_.clear();
  const auto visit = [&](std::uint32_t t) {
    if (side_[t] != Side::unknown || std::any_of(corners(t).begin(), corners(t).end(), is_far)) return;
    side_[t] = Side::outside, patch_.push_back(t);
  };
  visit(first);
  bool is_out = false;
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    for (const std::uint32_t v : corners(patch_[i])) {
      is_out = is_out || (winding_.closed && !overlap({inner_.world[v], inner_.world[v]}, outer_.box));
      for (std::uint32_t k = offsets_[v]; k < offsets_[v + 1]; ++k) visit(fans_[k]);
    }
  }
  if (patch_.empty() || is_out) return;
  if (winding_.closed) winding = winding_.at(middle);
  if (winding > 0.5)
    for (const std::uint32_t t : patch_) side_[t] = Side::inside;
}

}  // namespace impinge::clash
