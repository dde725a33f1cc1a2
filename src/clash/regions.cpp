// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions.hpp"

#include <algorithm>
#include <tuple>

#include "clash/grouping.hpp"
#include "clash/region_measures.hpp"
#include "clash/shared_parts.hpp"

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

}  // namespace

std::optional<std::vector<Region>> regions_of(const Side& a, const Side& b, std::span<const exact::Contact> contacts,
                                              const ForEach& for_each, const std::stop_token& stop) {
  const SharedParts parts = shared_parts(a, b, contacts, for_each, stop);
  if (stop.stop_requested()) return std::nullopt;
  DisjointSets groups(contacts.size());
  join_neighbours(a, b, contacts, parts, groups);
  for (const bool first : {true, false}) {
    if (stop.stop_requested()) return std::nullopt;
    if (!are_all_one(groups, contacts.size()))
      join_through(first ? a : b, first ? b : a, first, contacts, parts, groups);
  }
  const auto members = members_of(groups, contacts.size());
  std::vector<Region> regions(members.size());
  run_each(for_each, members.size(), [&](std::size_t i) {
    if (!stop.stop_requested()) regions[i] = measured(a, b, contacts, parts, members[i]);
  });
  if (stop.stop_requested()) return std::nullopt;
  // Groups are in the order of their first pairs, which decide between equals.
  std::stable_sort(regions.begin(), regions.end(), [](const Region& x, const Region& y) {
    return std::tie(x.area, x.length, x.pairs) > std::tie(y.area, y.length, y.pairs);
  });
  return regions;
}

}  // namespace impinge::clash
