// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/matching.hpp"

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "report/comparison/region_matching.hpp"

namespace impinge::report {
namespace {

/// Compares a pair with what the previous run knew of it.
void compare_with(const Previous::Pair& old, const Clash& pair, const Found& found, Standing& standing,
                  std::vector<Resolved>& resolved) {
  standing.was = old.verdict;
  // Whoever looked at it in the previous run saw no failure.
  const bool fails_now = found.names(pair, pair.verdict) && !found.names(pair, old.verdict);
  standing.change = fails_now ? Change::fresh : Change::persisting;
  for (RegionStanding& region : standing.regions) region.change = old.has_regions ? Change::fresh : standing.change;
  if (!old.has_regions) return;
  std::vector<bool> stays(old.regions.size());
  const auto matched = match_regions(pair.regions, old.regions, found.slack(pair));
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!matched[i]) continue;
    stays[*matched[i]] = true;
    standing.regions[i] = {old.regions[*matched[i]].id, Change::persisting};
  }
  for (std::size_t k = 0; k < stays.size(); ++k)
    if (!stays[k])
      resolved.push_back({old.id, old.regions[k].id, old.a, old.b, old.test, old.verdict, old.regions[k].centroid});
}

}  // namespace

std::vector<Standing> compare(const Found& found, const Previous* previous, std::vector<Resolved>& resolved) {
  std::unordered_map<std::string_view, const Previous::Pair*> gone;
  if (previous != nullptr)
    for (const Previous::Pair& pair : previous->pairs) gone.emplace(pair.id, &pair);
  std::vector<Standing> standings(found.pairs.size());
  for (std::size_t i = 0; i < standings.size(); ++i) {
    Standing& standing = standings[i];
    const Change change = previous != nullptr ? Change::fresh : Change::unknown;
    standing.change = change;
    standing.regions.resize(found.pairs[i].regions.size(), {{}, change});
    std::unordered_set<std::string> taken;
    if (const auto old = gone.find(found.ids[i]); old != gone.end()) {
      compare_with(*old->second, found.pairs[i], found, standing, resolved);
      for (const Previous::OldRegion& region : old->second->regions) taken.insert(region.id);
      gone.erase(old);
    }
    name_regions(found.ids[i], std::move(taken), standing.regions);
  }
  if (previous == nullptr) return standings;
  for (const Previous::Pair& pair : previous->pairs)
    if (gone.contains(pair.id)) resolved.push_back({pair.id, {}, pair.a, pair.b, pair.test, pair.verdict, pair.middle});
  return standings;
}

}  // namespace impinge::report
