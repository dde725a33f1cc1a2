// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/matching.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "report/comparison/region_matching.hpp"
#include "report/comparison/written.hpp"

namespace impinge::report {
namespace {

Resolved resolved_pair(const Previous::Pair& pair) {
  Resolved resolved{pair.id, {}, pair.a, pair.b, pair.test, pair.verdict, pair.middle, pair.remark, {}, 0, false};
  for (const Previous::OldRegion& region : pair.regions)
    if (!region.remark.is_empty())
      resolved.regions.push_back(
          {{}, region.id, {}, {}, {}, pair.verdict, region.centroid, region.remark, {}, region.reach, false});
  return resolved;
}

Resolved resolved_region(const Previous::Pair& pair, const Previous::OldRegion& region) {
  return {pair.id,         region.id,     pair.a, pair.b,       pair.test, pair.verdict,
          region.centroid, region.remark, {},     region.reach, false};
}

bool has_remark(const Resolved& resolved) { return !resolved.remark.is_empty() || !resolved.regions.empty(); }

/// Whether these are parts of this shape and in this place, in any order.
bool are(const OldPart& a, const OldPart& b, const std::pair<std::string_view, std::string_view>& placed) {
  if (a.placed.empty() || b.placed.empty()) return false;
  return std::pair<std::string_view, std::string_view>(a.placed, b.placed) == placed ||
         std::pair<std::string_view, std::string_view>(b.placed, a.placed) == placed;
}

Previous::Pair without_remarks(Previous::Pair pair) {
  pair.remark = {};
  for (Previous::OldRegion& region : pair.regions) region.remark = {};
  return pair;
}

/// One pair held against what the previous run knew of it.
class Comparison {
 public:
  Comparison(const Found& found, const Previous& previous, std::vector<Resolved>& resolved)
      : found_(found), previous_(previous), to_(resolved), is_back_(previous.resolved.size()) {
    for (std::size_t i = 0; i < previous.pairs.size(); ++i) pairs_.emplace(previous.pairs[i].id, i);
    for (std::size_t i = 0; i < previous.resolved.size(); ++i) resolved_[previous.resolved[i].id].push_back(i);
  }

  std::vector<Standing> compare() {
    std::vector<Standing> standings;
    for (const std::string& id : found_.ids) ids_.insert(id);
    for (std::size_t i = 0; i < found_.pairs.size(); ++i)
      standings.push_back(compare(found_.pairs[i], found_.ids[i], found_.ambiguous[i]));
    for (const Previous::Pair& pair : previous_.pairs)
      if (!ids_.contains(pair.id))
        to_.push_back(resolved_pair(dealt_with_.contains(pair.id) ? without_remarks(pair) : pair));
    // What nobody wrote about has been told once.
    for (std::size_t i = 0; i < previous_.resolved.size(); ++i)
      if (!is_back_[i] && has_remark(previous_.resolved[i])) to_.push_back(previous_.resolved[i]);
    for (Resolved& resolved : to_)
      resolved.is_ambiguous = resolved.is_elsewhere || ambiguous_.contains(resolved.id) ||
                              (gone_twins_.contains(resolved.id) && has_remark(resolved));
    return standings;
  }

 private:
  /// What the previous run knew of a pair, and of its twins if it is the only one left of them.
  struct Past {
    std::vector<const Previous::Pair*> pairs;
    std::vector<const Resolved*> resolved;  ///< whole pairs
  };

  Past past_of(const Clash& pair, const std::string& id, bool is_ambiguous) {
    std::vector<std::string> ids{id};
    const auto is_known = [&](const std::string& each) { return pairs_.contains(each) || resolved_.contains(each); };
    for (std::string& twin : found_.twins(pair, is_known)) {
      if (twin == id || ids_.contains(twin)) continue;
      if (is_ambiguous)
        gone_twins_.insert(std::move(twin));
      else
        ids.push_back(std::move(twin));
    }
    Past past;
    for (const std::string& each : ids) {
      if (const auto known = pairs_.find(each); known != pairs_.end())
        past.pairs.push_back(&previous_.pairs[known->second]);
      if (const auto known = resolved_.find(each); known != resolved_.end())
        for (const std::size_t i : known->second)
          if (previous_.resolved[i].region.empty()) past.resolved.push_back(&previous_.resolved[i]);
    }
    return past;
  }

  /// What the pair is known as; what was written about twins is in it if they agree, and else withheld.
  /// A part of their name in another place was neither of them.
  std::optional<Previous::Pair> known_as(const Clash& pair, const Past& past, const std::string& id,
                                         bool is_ambiguous) {
    if (past.pairs.empty()) return std::nullopt;
    const Previous::Pair* const written = first_written(past.pairs);
    Previous::Pair old = written != nullptr ? *written : *past.pairs.front();
    ids_.insert(past.pairs.front()->id);
    for (const Previous::Pair* const each : past.pairs) dealt_with_.insert(each->id);
    old.id = id;
    const auto placed = found_.placed(pair);
    const auto is_here = [&](const Previous::Pair* each) { return are(each->a, each->b, placed); };
    const bool is_left = past.pairs.size() == 1 || std::any_of(past.pairs.begin(), past.pairs.end(), is_here);
    if (written == nullptr || (!is_ambiguous && is_left && agree(past.pairs, *written))) return old;
    // It was there, or its equal was; what was written about which of them, nobody can say.
    for (const Previous::Pair* const each : past.pairs)
      if (Resolved withheld = resolved_pair(*each); has_remark(withheld)) withhold(std::move(withheld), id);
    return without_remarks(std::move(old));
  }

  void withhold(Resolved resolved, const std::string& id) {
    resolved.id = id;
    to_.push_back(std::move(resolved));
    ambiguous_.insert(id);
  }

  Standing compare(const Clash& pair, const std::string& id, bool is_ambiguous) {
    Standing standing;
    standing.regions.resize(pair.regions.size());
    is_matched_.assign(pair.regions.size(), false);
    std::unordered_set<std::string> used;
    if (is_ambiguous) ambiguous_.insert(id);
    const Past past = past_of(pair, id, is_ambiguous);
    const std::optional<Previous::Pair> old = known_as(pair, past, id, is_ambiguous);
    standing.change = old ? Change::persisting : Change::fresh;
    if (old) {
      standing.was = old->verdict;
      standing.remark = old->remark;
      // Whoever looked at it then saw no failure.
      if (found_.names(pair, pair.verdict) && !found_.names(pair, old->verdict)) standing.change = Change::fresh;
      if (old->has_regions)
        keep_regions(pair, *old, standing, used);
      else
        for (RegionStanding& region : standing.regions) region.change = standing.change;
    }
    if (is_ambiguous)
      keep_ids(id, used);
    else
      bring_back(pair, id, what_comes_back(pair, past, id, used), standing, used);
    for (RegionStanding& region : standing.regions)
      if (region.change == Change::unknown) region.change = Change::fresh;
    name_regions(id, std::move(used), standing.regions);
    return standing;
  }

  void keep_regions(const Clash& pair, const Previous::Pair& old, Standing& standing,
                    std::unordered_set<std::string>& used) {
    std::vector<EarlierRegion> earlier;
    for (const Previous::OldRegion& region : old.regions) {
      earlier.push_back({region.id, region.centroid, region.reach, &region.remark});
      used.insert(region.id);
    }
    std::vector<bool> stays(old.regions.size());
    const auto matched = match_regions(pair.regions, is_matched_, earlier, found_.slack(pair));
    for (std::size_t i = 0; i < matched.size(); ++i) {
      if (!matched[i]) continue;
      stays[*matched[i]] = true;
      take(standing.regions[i], earlier[*matched[i]], Change::persisting, i);
    }
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (!stays[k]) to_.push_back(resolved_region(old, old.regions[k]));
  }

  /// Of what had been resolved, which stays so.
  void keep_ids(const std::string& id, std::unordered_set<std::string>& used) const {
    const auto known = resolved_.find(id);
    if (known == resolved_.end()) return;
    for (const std::size_t i : known->second) {
      used.insert(previous_.resolved[i].region);
      for (const Resolved& region : previous_.resolved[i].regions) used.insert(region.region);
    }
  }

  /// Of what had been resolved of a pair that is there again, the whole pair, if any; it keeps what may be another's.
  const Resolved* what_comes_back(const Clash& pair, const Past& past, const std::string& id,
                                  std::unordered_set<std::string>& used) {
    const Previous::Pair* const known = first_written(past.pairs);
    const auto placed = found_.placed(pair);
    std::vector<const Resolved*> here;
    for (const Resolved* const each : past.resolved)
      if (are(each->a, each->b, placed)) here.push_back(each);
    const Resolved* const back = first_written(here);
    const bool is_taken = known == nullptr && back != nullptr && agree(here, *back);
    for (const Resolved* const each : past.resolved) {
      is_back_[static_cast<std::size_t>(each - previous_.resolved.data())] = true;
      const bool is_here = are(each->a, each->b, placed);
      const WrittenRemarks written = written_about(*each);
      if (written.is_empty() || (is_taken && is_here) || (known != nullptr && written == written_about(*known)))
        continue;
      if (is_here)
        withhold(*each, id);
      else
        leave_elsewhere(*each, used);
    }
    return is_taken ? back : nullptr;
  }

  /// What was written about parts that had these names, but maybe about others than those that have them now.
  void leave_elsewhere(Resolved resolved, std::unordered_set<std::string>& used) {
    used.insert(resolved.region);
    for (const Resolved& region : resolved.regions) used.insert(region.region);
    resolved.is_elsewhere = true;
    if (has_remark(resolved)) to_.push_back(std::move(resolved));
  }

  /// Remarks on what had been resolved and is there again; `whole` is the pair itself, if that had been, or null.
  void bring_back(const Clash& pair, const std::string& id, const Resolved* whole, Standing& standing,
                  std::unordered_set<std::string>& used) {
    if (whole != nullptr) {
      standing.remark = whole->remark;
      std::vector<Resolved> entries;
      for (const Resolved& region : whole->regions) {
        entries.push_back(*whole);
        entries.back().id = id, entries.back().regions.clear();
        entries.back().region = region.region, entries.back().remark = region.remark;
        entries.back().centroid = region.centroid, entries.back().reach = region.reach;
      }
      // Also to regions that were there without what had been withheld.
      std::vector<bool> is_taken(standing.regions.size());
      for (std::size_t i = 0; i < is_taken.size(); ++i) is_taken[i] = !standing.regions[i].remark.is_empty();
      bring_back(pair, std::move(entries), is_taken, standing, used);
    }
    const auto known = resolved_.find(id);
    if (known == resolved_.end()) return;
    std::vector<Resolved> entries;
    for (const std::size_t i : known->second) {
      const Resolved& region = previous_.resolved[i];
      if (region.region.empty()) continue;
      is_back_[i] = true;
      // While its pair was gone, other parts may have taken the names.
      const bool stayed = pairs_.contains(id) && !region.is_ambiguous;
      if (stayed || are(region.a, region.b, found_.placed(pair)))
        entries.push_back(region);
      else
        leave_elsewhere(region, used);
    }
    bring_back(pair, std::move(entries), std::vector<bool>(is_matched_), standing, used);
  }

  /// Regions that had been resolved, to those that are not taken.
  void bring_back(const Clash& pair, std::vector<Resolved> entries, const std::vector<bool>& is_taken,
                  Standing& standing, std::unordered_set<std::string>& used) {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    std::vector<EarlierRegion> earlier;
    for (const Resolved& entry : entries) {
      used.insert(entry.region);
      earlier.push_back(
          {entry.region, entry.centroid.value_or(Point{kNowhere, kNowhere, kNowhere}), entry.reach, &entry.remark});
    }
    std::vector<bool> is_there(entries.size());
    const auto matched = match_regions(pair.regions, is_taken, earlier, found_.slack(pair));
    for (std::size_t i = 0; i < matched.size(); ++i) {
      if (!matched[i]) continue;
      is_there[*matched[i]] = true;
      if (is_matched_[i])
        standing.regions[i].remark = entries[*matched[i]].remark;
      else
        take(standing.regions[i], earlier[*matched[i]], Change::fresh, i);
    }
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (!is_there[k] && has_remark(entries[k])) to_.push_back(std::move(entries[k]));
  }

  void take(RegionStanding& region, const EarlierRegion& earlier, Change change, std::size_t number) {
    region = {earlier.id, change, *earlier.remark};
    is_matched_[number] = true;
  }

  const Found& found_;
  const Previous& previous_;
  std::vector<Resolved>& to_;
  std::vector<bool> is_back_;                   ///< of what had been resolved: its pair is there again
  std::vector<bool> is_matched_;                ///< of the regions of the pair that is looked at
  std::unordered_set<std::string> ids_;         ///< of pairs that are there
  std::unordered_set<std::string> ambiguous_;   ///< of those, by which something is withheld
  std::unordered_set<std::string> gone_twins_;  ///< of pairs that are not there, but twins of theirs are
  std::unordered_set<std::string> dealt_with_;  ///< of pairs of which what was written is dealt with
  std::unordered_map<std::string_view, std::size_t> pairs_;
  std::unordered_map<std::string_view, std::vector<std::size_t>> resolved_;
};

}  // namespace

std::vector<Standing> stand_alone(const Found& found) {
  std::vector<Standing> standings(found.pairs.size());
  for (std::size_t i = 0; i < standings.size(); ++i) {
    standings[i].regions.resize(found.pairs[i].regions.size());
    name_regions(found.ids[i], {}, standings[i].regions);
  }
  return standings;
}

std::vector<Standing> compare(const Found& found, const Previous& previous, std::vector<Resolved>& resolved) {
  return Comparison(found, previous, resolved).compare();
}

}  // namespace impinge::report
