// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/regions.hpp"

#include <algorithm>
#include <tuple>

#include "clash/contact_pairs.hpp"
#include "clash/regions/grouping.hpp"
#include "clash/regions/near_corners.hpp"
#include "clash/regions/region_measures.hpp"
#include "clash/regions/resolution.hpp"
#include "clash/regions/shared_parts.hpp"
#include "clash/regions/welded.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// The numbers of each group's contacts, in order; groups in the order of their first.
std::vector<std::vector<std::uint32_t>> members_of(DisjointSets& groups, std::size_t contacts) {
  std::vector<std::vector<std::uint32_t>> members;
  std::vector<std::uint32_t> number(contacts);
  for (std::uint32_t i = 0; i < contacts; ++i) {
    const std::uint32_t group = groups.find(i);
    if (group == i) {
      number[i] = static_cast<std::uint32_t>(members.size());
      members.emplace_back();
    }
    members[number[group]].push_back(i);
  }
  return members;
}

bool are_all_one(DisjointSets& groups, std::size_t contacts) {
  for (std::uint32_t i = 0; i < contacts; ++i)
    if (groups.find(i) != 0) return false;
  return true;
}

/// A point that is near the boundary is on it.
Side within(const Side& side, double tolerance) {
  Side result = side;
  if (tolerance > 0 && side.holds)
    result.holds = [&side, tolerance](const Vec3& p) {
      return side.holds(p) && !measure::nearest_point(side.body.placed, p, tolerance, tolerance);
    };
  return result;
}

}  // namespace

std::optional<std::vector<Region>> regions_of(const Side& exact_a, const Side& exact_b,
                                              std::span<const exact::Contact> contacts, double tolerance,
                                              const ForEach& for_each, const std::stop_token& stop) {
  const Side a = within(exact_a, tolerance), b = within(exact_b, tolerance);
  const Reach reach = reach_of(a, b, contacts, tolerance);
  SharedParts parts = shared_parts(a, b, contacts, reach, for_each, stop);
  if (stop.stop_requested()) return std::nullopt;
  // Twice the distance over which points were moved, for lines have moved too.
  const double within_line = tolerance > 0 ? 2 * welding_distance(parts, reach) : 0;
  if (tolerance > 0) parts = welded(a, b, contacts, parts, reach);
  DisjointSets groups(contacts.size());
  if (tolerance > 0) join_near_corners(parts, contacts.size(), tolerance, groups);
  join_neighbours(a, b, contacts, parts, groups);
  for (const bool first : {true, false}) {
    if (stop.stop_requested()) return std::nullopt;
    if (!are_all_one(groups, contacts.size()))
      join_through(first ? a : b, first ? b : a, first, contacts, parts, groups);
  }
  const auto members = members_of(groups, contacts.size());
  std::vector<Region> regions(members.size());
  run_each(for_each, members.size(), [&](std::size_t i) {
    if (!stop.stop_requested()) regions[i] = measured(a, b, contacts, parts, members[i], within_line);
  });
  if (stop.stop_requested()) return std::nullopt;
  // Groups are in the order of their first pairs, which decide between equals.
  std::stable_sort(regions.begin(), regions.end(), [](const Region& x, const Region& y) {
    return std::tie(x.area, x.length, x.pairs) > std::tie(y.area, y.length, y.pairs);
  });
  return regions;
}

std::size_t most_small_pairs(const solid::Body& a, const solid::Body& b) {
  return (1 << 20) + 64 * (a.size() + b.size());
}

std::optional<std::vector<exact::Contact>> contacts_within(const solid::Body& a, const solid::Body& b, double tolerance,
                                                           std::size_t most, const std::stop_token& stop) {
  std::vector<exact::Contact> contacts;
  std::size_t small = 0;
  const auto take = [&](const TrianglePair& pair) {
    contacts.push_back({pair.a, pair.b, Kind::touching});
    if (is_small(a.triangle(pair.a), tolerance) && is_small(b.triangle(pair.b), tolerance)) ++small;
    return small <= most;
  };
  measure::near_pairs(a.placed, b.placed, tolerance, take, stop);
  if (small > most) return std::nullopt;
  std::sort(contacts.begin(), contacts.end(),
            [](const auto& x, const auto& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  return contacts;
}

}  // namespace impinge::clash
