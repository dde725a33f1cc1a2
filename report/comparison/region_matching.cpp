// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/region_matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "report/identity.hpp"

namespace impinge::report {
namespace {

// Of those that moved all pairs are looked at. They come largest first: of more than so many the rest does not matter,
// and no file makes a run take forever.
constexpr std::size_t kMostRegions = 2000;

double distance_between(const Point& p, const Point& q) { return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z); }

double reach_of(const Region& region) {
  const auto& [lo, hi] = region.box;
  return distance_between({lo.x / 2, lo.y / 2, lo.z / 2}, {hi.x / 2, hi.y / 2, hi.z / 2});
}

/// Regions, the earlier ones, and which of them is which.
class RegionMatch {
 public:
  RegionMatch(const std::vector<Region>& regions, const std::vector<Previous::OldRegion>& earlier)
      : regions_(regions), earlier_(earlier), matched_(regions.size()), is_used_(earlier.size()) {}

  /// What stayed in its place, however many regions there are.
  void match_unmoved() {
    std::map<std::array<double, 3>, std::vector<std::size_t>> places;  // the last number comes first
    for (std::size_t k = earlier_.size(); k-- > 0;) places[coordinates(earlier_[k].centroid)].push_back(k);
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      const auto there = places.find(coordinates(regions_[i].centroid));
      if (there == places.end() || there->second.empty()) continue;
      take(i, there->second.back());
      there->second.pop_back();
    }
  }

  void match_nearest(double slack) {
    struct Candidate {
      double distance;
      std::size_t region, earlier;
    };
    std::vector<Candidate> candidates;
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < earlier_.size() && left.size() < kMostRegions; ++k)
      if (!is_used_[k]) left.push_back(k);
    std::size_t count = 0;
    for (std::size_t i = 0; i < regions_.size() && count < kMostRegions; ++i) {
      if (matched_[i]) continue;
      ++count;
      const double reach = reach_of(regions_[i]) + slack;
      for (const std::size_t k : left) {
        const double distance = distance_between(regions_[i].centroid, earlier_[k].centroid);
        if (distance <= reach + earlier_[k].reach) candidates.push_back({distance, i, k});
      }
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
      return std::tie(x.distance, x.region, x.earlier) < std::tie(y.distance, y.region, y.earlier);
    });
    for (const Candidate& candidate : candidates)
      if (!matched_[candidate.region] && !is_used_[candidate.earlier]) take(candidate.region, candidate.earlier);
  }

  std::vector<std::optional<std::size_t>> result() && { return std::move(matched_); }

 private:
  static std::array<double, 3> coordinates(const Point& p) { return {p.x, p.y, p.z}; }

  void take(std::size_t region, std::size_t earlier) {
    matched_[region] = earlier;
    is_used_[earlier] = true;
  }

  const std::vector<Region>& regions_;
  const std::vector<Previous::OldRegion>& earlier_;
  std::vector<std::optional<std::size_t>> matched_;
  std::vector<bool> is_used_;
};

}  // namespace

std::vector<std::optional<std::size_t>> match_regions(const std::vector<Region>& regions,
                                                      const std::vector<Previous::OldRegion>& earlier, double slack) {
  RegionMatch match(regions, earlier);
  match.match_unmoved();
  match.match_nearest(slack);
  return std::move(match).result();
}

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

}  // namespace impinge::report
