// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "report/comparison/previous.hpp"
#include "report/identity.hpp"
#include "report/vector.hpp"

namespace impinge::report {
namespace {

// Of those that moved all pairs are looked at. They come largest first: of more than so many the rest does not matter,
// and no file makes a run take forever.
constexpr std::size_t kMostMoved = 2000;

/// A region that may be an earlier one, by the numbers of both.
struct Candidate {
  double distance;
  std::size_t region, earlier;
};

/// For each region the index of the earlier one that it is, or nothing; the nearest two first, as far as half the
/// diagonals of both boxes and `slack` reach. Of more than 2,000 regions that moved, the rest are not compared.
std::vector<std::optional<std::size_t>> match_regions(const std::vector<Region>& regions,
                                                      const std::vector<Previous::OldRegion>& earlier, double slack) {
  std::vector<std::optional<std::size_t>> matched(regions.size());
  std::vector<bool> is_used(earlier.size());
  const auto take = [&](std::size_t region, std::size_t of_then) {
    if (matched[region] || is_used[of_then]) return;
    matched[region] = of_then;
    is_used[of_then] = true;
  };
  // What stayed in its place, however many regions there are; of several in one place the first with the first.
  const auto coordinates = [](const Point& p) { return std::array{p.x, p.y, p.z}; };
  std::map<std::array<double, 3>, std::deque<std::size_t>> places;
  for (std::size_t k = 0; k < earlier.size(); ++k) places[coordinates(earlier[k].centroid)].push_back(k);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto there = places.find(coordinates(regions[i].centroid));
    if (there == places.end() || there->second.empty()) continue;
    take(i, there->second.front());
    there->second.pop_front();
  }
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < earlier.size() && left.size() < kMostMoved; ++k)
    if (!is_used[k]) left.push_back(k);
  std::vector<Candidate> candidates;
  std::size_t count = 0;
  for (std::size_t i = 0; i < regions.size() && count < kMostMoved; ++i) {
    if (matched[i]) continue;
    ++count;
    const auto& [lo, hi] = regions[i].box;
    const double reach = length(0.5 * hi - 0.5 * lo) + slack;
    for (const std::size_t k : left) {
      const double distance = length(regions[i].centroid - earlier[k].centroid);
      if (distance <= reach + earlier[k].half_diagonal) candidates.push_back({distance, i, k});
    }
  }
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::tie(c.distance, c.region, c.earlier); });
  for (const Candidate& candidate : candidates) take(candidate.region, candidate.earlier);
  return matched;
}

/// Gives ids to regions that have none: made of the pair's id and the first numbers that give no id in `taken`.
void name_regions(const std::string& pair, std::unordered_set<std::string> taken,
                  std::vector<RegionStanding>& regions) {
  for (const RegionStanding& region : regions) taken.insert(region.id);
  std::size_t number = 0;
  for (RegionStanding& region : regions)
    while (region.id.empty()) {
      std::string id = guid_of(fmt::format("{}/{}", pair, number++));
      if (taken.insert(id).second) region.id = std::move(id);
    }
}

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
