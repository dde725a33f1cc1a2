// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/nested_patches.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "solid/locate.hpp"

namespace impinge::solid {
namespace {

using PatchSet = std::set<std::uint32_t>;

class Nesting {
 public:
  Nesting(const Body& body, const Topology& topology, const Orientation& orientation)
      : body_(body), topology_(topology), orientation_(orientation) {}

  /// The closed patches within which a closed patch, that of these triangles, lies.
  [[nodiscard]] PatchSet around(const std::vector<std::uint32_t>& triangles, const std::stop_token& stop) const {
    const std::uint32_t own = orientation_.patch[triangles.front()];
    PatchSet possible, certain, seen;
    for (const std::uint32_t t : triangles) {
      const auto corners = topology_.corners(body_, t);
      for (std::size_t k = 0; k < 3; ++k) {
        if (!seen.insert(corners[k]).second) continue;
        const Sides at = sides_at(body_.triangle(t)[k]);
        PatchSet either = at.inside;
        either.insert(at.on.begin(), at.on.end());
        either.erase(own);
        if (seen.size() == 1) possible = either;
        std::erase_if(possible, [&](std::uint32_t p) { return !either.contains(p); });
        for (const std::uint32_t p : possible)
          if (!at.on.contains(p)) certain.insert(p);
        if (possible.empty() || stop.stop_requested()) return {};
      }
    }
    std::erase_if(certain, [&](std::uint32_t p) { return !possible.contains(p); });
    return certain;
  }

 private:
  struct Sides {
    PatchSet inside, on;  ///< the closed patches that wind around a point, and those on whose triangles it lies
  };

  [[nodiscard]] Sides sides_at(const Vec3& point) const {
    Sides sides;
    const Crossings found = crossings_around(body_.placed, point);
    std::map<std::uint32_t, int> winding;
    for (const auto& [triangle, way] : found.crossings)
      if (is_of_closed(triangle))
        winding[orientation_.patch[triangle]] += orientation_.is_turned[triangle] ? -way : way;
    for (const auto& [patch, number] : winding)
      if (number != 0) sides.inside.insert(patch);
    for (const std::uint32_t triangle : found.holders)
      if (is_of_closed(triangle)) sides.on.insert(orientation_.patch[triangle]);
    return sides;
  }
  [[nodiscard]] bool is_of_closed(std::uint32_t triangle) const {
    const std::uint32_t patch = orientation_.patch[triangle];
    return patch != Orientation::kNoPatch && orientation_.is_closed[patch];
  }

  const Body& body_;
  const Topology& topology_;
  const Orientation& orientation_;
};

}  // namespace

std::vector<std::uint32_t> outermost_patches(const Body& body, const Topology& topology, const Orientation& orientation,
                                             const std::stop_token& stop) {
  std::vector<std::uint32_t> outermost(orientation.is_closed.size());
  std::iota(outermost.begin(), outermost.end(), 0U);
  if (std::count(orientation.is_closed.begin(), orientation.is_closed.end(), true) < 2) return outermost;
  std::vector<std::vector<std::uint32_t>> members(orientation.is_closed.size());
  for (std::uint32_t t = 0; t < body.size(); ++t)
    if (orientation.patch[t] != Orientation::kNoPatch) members[orientation.patch[t]].push_back(t);
  const Nesting nesting(body, topology, orientation);
  std::vector<PatchSet> around(members.size());
  for (std::size_t p = 0; p < members.size() && !stop.stop_requested(); ++p)
    if (orientation.is_closed[p]) around[p] = nesting.around(members[p], stop);
  for (std::size_t p = 0; p < members.size(); ++p) {
    const auto first =
        std::find_if(around[p].begin(), around[p].end(), [&](std::uint32_t q) { return around[q].empty(); });
    if (first != around[p].end()) outermost[p] = *first;
  }
  return outermost;
}

}  // namespace impinge::solid
