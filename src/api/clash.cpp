// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/clash.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "clash/depth.hpp"
#include "clash/overlap_volume.hpp"
#include "core/guarded.hpp"
#include "core/local_frame.hpp"
#include "core/pose.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/equal_pairs.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "pipeline/pair_judge.hpp"
#include "pipeline/part.hpp"
#include "pipeline/previous_clashes.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/stage_clock.hpp"
#include "scene/validate_pose.hpp"

namespace impinge {
namespace {

Result<void> validate(const ClashOptions& options) {
  if (auto valid = impinge::validate(Options{.threads = options.threads, .backend = options.backend}); !valid)
    return valid;
  const auto check = [](double length, const std::string& what) -> Result<void> {
    if (length >= 0 && std::isfinite(length)) return {};
    return Error{Code::bad_option, what + " is " + std::to_string(length) + "; choose a length, 0 or more"};
  };
  if (auto valid = check(options.tolerance.value_or(0), "tolerance"); !valid) return valid;
  if (!(options.depth_precision > 0))
    return Error{Code::bad_option, "depth_precision is " + std::to_string(options.depth_precision) +
                                       "; choose one above 0, or infinity for verdicts alone"};
  return check(options.clearance, "clearance");
}

Result<void> check_domain(const std::vector<Placed>& objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].mesh == nullptr || in_exact_domain(objects[i].pose, objects[i].mesh->state().data)) continue;
    return not_in_exact_domain("object " + std::to_string(i));
  }
  return {};
}

bool is_listed(const Clash& clash, const ClashTerms& terms) {
  return clash.verdict <= terms.last && (clash.verdict != Verdict::apart || clash.nearest);
}

/// An object's world box, and how far rounding may have moved its vertices.
struct Bounds {
  Box box;
  double rounding;
};

/// Pairs whose boxes come as near as the options ask for, sorted.
std::vector<std::uint64_t> find_candidates(const Scene::State& scene, const std::vector<Bounds>& bounds,
                                           const ClashOptions& options) {
  double largest = 0;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (scene.meshes[i] != nullptr) largest = std::max(largest, largest_coordinate(bounds[i].box));
  const double least = std::max(options.terms ? 0 : options.tolerance.value_or(0), options.clearance);
  std::vector<Box> boxes(bounds.size(), kEmpty);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = bounds[i].box;
    if (scene.meshes[i] == nullptr || is_empty(box)) continue;
    // Each box grows by half of the reach or its share of the automatic tolerance, and by what rounding may take from
    // that.
    const double reach = std::max(least / 2, bounds[i].rounding + 0x1p-42 * largest);
    const double half = reach + 0x1p-49 * (largest + reach);
    boxes[i] = {box.lo - Vec3{half, half, half}, box.hi + Vec3{half, half, half}};
  }
  return scene.overlapping(boxes);
}

/// The terms of a pair of objects; one for all without `ClashOptions::terms`.
std::vector<ClashTerms> terms_of(std::uint32_t a, std::uint32_t b, const ClashOptions& options) {
  std::vector<ClashTerms> terms;
  if (options.terms)
    options.terms(a, b, terms);
  else
    terms.push_back({options.tolerance, options.clearance});
  return terms;
}

bool reaches_farther(const ClashTerms& terms, const ClashOptions& options) {
  const auto is_within = [&](double length) { return length >= 0 && length <= options.clearance; };
  return !is_within(terms.tolerance.value_or(0)) || !is_within(terms.clearance);
}

/// Judges each candidate that has terms, in their order; `equal` groups them. Errors: `bad_option`, `cancelled`.
Result<std::vector<JudgedPair>> judge_all(const std::vector<std::uint64_t>& candidates, const EqualPairs& equal,
                                          const std::vector<Part>& parts, const PreviousClashes& previous,
                                          const ClashOptions& options) {
  std::vector<JudgedPair> pairs(candidates.size());
  std::atomic<bool> too_far = false;
  std::vector<std::optional<Error>> errors(equal.size());
  const auto judge_one = [&](std::size_t i, PairJudge& pair) {
    const auto a = static_cast<std::uint32_t>(candidates[i] >> 32), b = static_cast<std::uint32_t>(candidates[i]);
    JudgedPair& judged = pairs[i];
    judged.objects = candidates[i];
    judged.terms = terms_of(a, b, options);
    const auto is_too_far = [&](const ClashTerms& each) { return reaches_farther(each, options); };
    if (options.terms && std::any_of(judged.terms.begin(), judged.terms.end(), is_too_far)) {
      too_far = true;
      return;
    }
    if (const JudgedPair* const same = previous.find(candidates[i], judged.terms)) {
      judged = *same;
      judged.is_reused = true;
      Steps(options.progress).step();
      return;
    }
    std::vector<Clash> clashes = pair.judge(judged.terms);
    for (std::size_t k = 0; k < clashes.size(); ++k) {
      clashes[k].objects = {a, b};
      if (is_listed(clashes[k], judged.terms[k])) judged.clashes.push_back(std::move(clashes[k]));
    }
    Steps(options.progress).step();
  };
  run_each(on_threads(options.threads), equal.size(), [&](std::size_t row) {
    const std::uint64_t first = candidates[equal.row(row).front()];
    PairJudge pair(parts[first >> 32], parts[static_cast<std::uint32_t>(first)], options);
    for (const std::size_t i : equal.row(row)) {
      if (options.stop.stop_requested()) return;
      judge_one(i, pair);
    }
    errors[row] = pair.error();
  });
  if (options.stop.stop_requested()) return cancelled();
  for (const std::optional<Error>& error : errors)
    if (error) return *error;
  if (too_far)
    return Error{Code::bad_option,
                 "the terms of a pair have a tolerance or clearance that is negative, not finite or above the options' "
                 "clearance; raise that to the greatest of all"};
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const JudgedPair& pair) { return pair.terms.empty(); }),
              pairs.end());
  return pairs;
}

/// Lists the clashes of all pairs: copies them if the pairs stay in a memory, moves them otherwise.
std::vector<Clash> list_clashes(std::vector<JudgedPair>& pairs, bool stays) {
  std::vector<Clash> clashes;
  for (JudgedPair& pair : pairs) {
    if (stays)
      clashes.insert(clashes.end(), pair.clashes.begin(), pair.clashes.end());
    else
      std::move(pair.clashes.begin(), pair.clashes.end(), std::back_inserter(clashes));
  }
  return clashes;
}

/// `previous` holds the results of the last query, and afterwards those of this one; after an error, none.
Result<Clashes> clashes_of(const Scene::State& scene, const ClashOptions& options, PreviousClashes& previous,
                           bool stays) {
  StageClock clock;
  Clashes result;
  PreviousClashes last = std::exchange(previous, {});
  std::vector<Placed> objects;
  for (std::size_t i = 0; i < scene.slots.size(); ++i)
    objects.push_back({scene.slots[i].mesh ? &*scene.slots[i].mesh : nullptr, scene.objects[i].pose});
  if (auto valid = check_domain(objects); !valid) return valid.error();
  const std::vector<Placed> others = last.forget_changed(objects, options);
  std::vector<solid::Body> bodies = bodies_of(others, options.threads);
  std::vector<Bounds> bounds;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const solid::Body* const kept = last.unchanged_body(i);
    const solid::Body& body = kept != nullptr ? *kept : bodies[i];
    bounds.push_back({body.box, objects[i].mesh != nullptr ? rounding_of(body) : 0});
  }
  const std::vector<std::uint64_t> candidates = find_candidates(scene, bounds, options);
  result.candidates = candidates.size();
  const Steps steps(options.progress);
  steps.begin(steps_of_parts(others) + candidates.size());
  const EqualPairs equal = group_equal_pairs(candidates, first_equal(objects));
  auto parts = make_parts(others, std::move(bodies), options);
  if (!parts) return parts.error();
  last.move_parts_to(*parts);
  for (const Part& part : *parts) result.parts.push_back(part.facts);
  clock.charge(result.parts_seconds);

  auto pairs = judge_all(candidates, equal, *parts, last, options);
  if (!pairs) return pairs.error();
  result.candidates = pairs->size();
  result.pairs = list_clashes(*pairs, stays);
  if (stays) previous = PreviousClashes(objects, *std::move(parts), *std::move(pairs), options);
  clock.charge(result.pairs_seconds);
  return result;
}

Result<std::vector<Part>> make_placed_parts(const std::vector<Placed>& objects, const ClashOptions& options) {
  if (auto valid = validate(options); !valid) return valid.error();
  for (const Placed& object : objects)
    if (auto valid = scene::validate(object.pose); !valid) return valid.error();
  if (auto valid = check_domain(objects); !valid) return valid.error();
  return make_parts(objects, bodies_of(objects, options.threads), options);
}

}  // namespace

Result<Clashes> find_clashes(const Scene& scene, const ClashOptions& options, ClashMemory* memory) {
  return guarded([&]() -> Result<Clashes> {
    PreviousClashes none;
    PreviousClashes& previous = memory != nullptr ? memory->state_->clashes : none;
    if (auto valid = validate(options); !valid) {
      previous = {};
      return valid.error();
    }
    return clashes_of(*scene.state_, options, previous, memory != nullptr);
  });
}

Result<Clash> judge(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                    const ClashOptions& options) {
  return guarded([&]() -> Result<Clash> {
    const auto parts = make_placed_parts({{&mesh_a, pose_a}, {&mesh_b, pose_b}}, options);
    if (!parts) return parts.error();
    const ClashTerms terms{options.tolerance, options.clearance};
    PairJudge pair((*parts)[0], (*parts)[1], options);
    Clash clash = pair.judge({&terms, 1}).front();
    if (pair.error()) return *pair.error();
    if (options.stop.stop_requested()) return cancelled();
    clash.objects = {0, 1};
    return clash;
  });
}

namespace {

/// The parts of a measure of solids.
Result<std::vector<Part>> closed_parts(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                       const MeasureOptions& options) {
  auto parts =
      make_placed_parts({{&mesh_a, pose_a}, {&mesh_b, pose_b}}, {.threads = options.threads, .stop = options.stop});
  for (std::size_t i = 0; parts && i < 2; ++i)
    if (!(*parts)[i].facts.closed)
      return Error{Code::bad_mesh, std::string(i == 0 ? "the first mesh" : "the second mesh") +
                                       " is not closed, so that nothing is inside of it; close it, or ask for the "
                                       "distance instead"};
  return parts;
}

}  // namespace

Result<OverlapDepth> overlap_depth(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                   double precision, const MeasureOptions& options) {
  return guarded([&]() -> Result<OverlapDepth> {
    if (!(precision > 0 && precision <= 1))
      return Error{Code::bad_option, "precision is " + std::to_string(precision) + "; choose one above 0, up to 1"};
    const auto parts = closed_parts(mesh_a, pose_a, mesh_b, pose_b, options);
    if (!parts) return parts.error();
    const OverlapDepth depth = find_depths((*parts)[0], (*parts)[1], {.precision = precision, .stop = options.stop});
    if (options.stop.stop_requested()) return cancelled();
    return depth;
  });
}

Result<OverlapVolume> overlap_volume(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                                     const MeasureOptions& options) {
  return guarded([&]() -> Result<OverlapVolume> {
    const auto parts = closed_parts(mesh_a, pose_a, mesh_b, pose_b, options);
    if (!parts) return parts.error();
    const auto found = clash::overlap_volume((*parts)[0].placed, (*parts)[1].placed, options.stop);
    if (options.stop.stop_requested()) return cancelled();
    if (!found) return Error{Code::bad_mesh, "the two meshes touch in more ways than shifting one of them can part"};
    return *found;
  });
}

Result<PartFacts> examine(const Mesh& mesh, const Pose& pose, const ClashOptions& options) {
  return guarded([&]() -> Result<PartFacts> {
    const auto parts = make_placed_parts({{&mesh, pose}}, options);
    if (!parts) return parts.error();
    return (*parts)[0].facts;
  });
}

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 6> kNames{"duplicate", "inside",   "penetrating",
                                                   "crossing",  "touching", "apart"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string_view name(PartClass part_class) {
  constexpr std::array<std::string_view, 3> kNames{"solid", "cracked", "surface"};
  return kNames[static_cast<std::size_t>(part_class)];
}

std::string_view sentence(Note note) {
  constexpr std::array<std::string_view, 5> kSentences{
      "", "they reach into each other by no more than the tolerance", "they are apart by no more than the tolerance",
      "they may reach into each other by more than the tolerance; it could not be told",
      "the tolerance is raised to the least that such coordinates can tell"};
  return kSentences[static_cast<std::size_t>(note)];
}

}  // namespace impinge
