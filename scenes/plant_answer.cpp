// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/plant_answer.hpp"

#include <optional>

namespace impinge::scenes {
namespace {

using Objects = std::array<std::uint32_t, 2>;

/// What is wrong with what was found of a planted pair, if anything is.
std::optional<std::string> fault(const PlantPair& planted, const Clash& found, double slack) {
  if (found.verdict != planted.verdict || found.inner != planted.inner) {
    return in_words(found.verdict, found.inner) + " instead of " + in_words(planted.verdict, planted.inner);
  }
  if (planted.verdict != Verdict::apart) return std::nullopt;
  if (!found.nearest) return "apart, with no distance";
  const double distance = found.nearest->distance, room = slack + found.nearest->error;
  if (distance >= planted.distance.lo - room && distance <= planted.distance.hi + room) return std::nullopt;
  return "at distance " + std::to_string(distance) + " instead of " + std::to_string(planted.distance.lo) + " to " +
         std::to_string(planted.distance.hi);
}

class Comparison {
 public:
  Comparison(const Plant& plant, const PlantQuestion& question) : plant_(plant), question_(question) {}

  PlantAnswer compare(std::span<const Clash> pairs) {
    auto found = pairs.begin();
    for (const PlantPair& planted : plant_.pairs) {
      const Objects objects{planted.first, planted.second};
      for (; found != pairs.end() && found->objects < objects; ++found) add_unexpected(*found);
      const bool is_there = found != pairs.end() && found->objects == objects;
      add(planted, is_there ? &*found++ : nullptr);
    }
    for (; found != pairs.end(); ++found) add_unexpected(*found);
    return std::move(answer_);
  }

 private:
  void add(const PlantPair& planted, const Clash* found) {
    // A pair whose distance may be on either side of the clearance is no one's fault.
    const bool may_be_missing =
        planted.verdict == Verdict::apart && planted.distance.hi + question_.slack >= question_.clearance;
    const bool is_wanted =
        planted.verdict != Verdict::apart || planted.distance.lo - question_.slack < question_.clearance;
    if (!found && may_be_missing) return;
    PlantScore& score = answer_.scores[planted.family];
    ++score.planted;
    std::optional<std::string> problem =
        found ? fault(planted, *found, question_.slack) : std::optional<std::string>("missing");
    if (!problem && !is_wanted) problem = "listed, beyond the clearance";
    if (problem)
      say({planted.first, planted.second}, *problem + ": " + std::string(planted.family));
    else
      ++score.right;
  }

  void add_unexpected(const Clash& found) {
    say(found.objects, in_words(found.verdict, found.inner) + " instead of apart and far");
  }

  void say(const Objects& objects, const std::string& problem) {
    const char* const bay = plant_.is_turned[plant_.bays[objects[0]]] ? " (turned bay)" : "";
    answer_.faults.push_back(plant_.names[objects[0]] + " and " + plant_.names[objects[1]] + ": " + problem + bay);
  }

  const Plant& plant_;
  PlantQuestion question_;
  PlantAnswer answer_;
};

}  // namespace

PlantAnswer compare(const Plant& plant, std::span<const Clash> pairs, const PlantQuestion& question) {
  return Comparison(plant, question).compare(pairs);
}

std::string in_words(Verdict verdict, int inner) {
  switch (verdict) {
    case Verdict::duplicate:
      return "duplicate";
    case Verdict::inside:
      return inner == 0 ? "inside: the first in the second" : "inside: the second in the first";
    case Verdict::penetrating:
      return "penetrating";
    case Verdict::crossing:
      return "crossing";
    case Verdict::touching:
      return "touching";
    case Verdict::apart:
      break;
  }
  return "apart";
}

}  // namespace impinge::scenes
