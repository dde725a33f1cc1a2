// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/grouping.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace impinge::clash {
namespace {

/// Joins all members that have a key in common.
template <class Key>
void join_equal(std::vector<std::pair<Key, std::uint32_t>>& keyed, DisjointSets& groups) {
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 1; i < keyed.size(); ++i)
    if (keyed[i].first == keyed[i - 1].first) groups.join(keyed[i].second, keyed[i - 1].second);
}

}  // namespace

// Two pairs are neighbours if and only if some position of a's triangles and some position of b's are in both: nine
// keys a pair. A key that a pair has twice does no harm.
void join_neighbours(const Side& a, const Side& b, std::span<const exact::Contact> contacts, const SharedParts& parts,
                     DisjointSets& groups) {
  {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    keyed.reserve(9 * contacts.size());
    for (std::uint32_t i = 0; i < contacts.size(); ++i)
      for (const std::uint32_t p : a.corners(contacts[i].a))
        for (const std::uint32_t q : b.corners(contacts[i].b)) keyed.emplace_back(std::uint64_t{p} << 32 | q, i);
    join_equal(keyed, groups);
  }
  std::vector<std::pair<std::array<double, 3>, std::uint32_t>> keyed;
  keyed.reserve(parts.corners.size());
  for (std::uint32_t i = 0; i < contacts.size(); ++i)
    for (const auto& [p, edges] : parts[i]) keyed.push_back({{p.x, p.y, p.z}, i});
  join_equal(keyed, groups);
}

}  // namespace impinge::clash
