// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/impacts_of_pairs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/stopped.hpp"
#include "motion/impact_search.hpp"
#include "pipeline/on_threads.hpp"

namespace impinge {
namespace {

/// With as few digits as tell it from all others.
std::string shortest(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

bool sooner(const Interval& x, const Interval& y) { return std::tie(x.lo, x.hi) < std::tie(y.lo, y.hi); }

}  // namespace

Result<void> validate(const MotionOptions& options) {
  if (options.threads < 0)
    return Error{Code::bad_option,
                 "a number of threads is 0 (all there are) or more, not " + std::to_string(options.threads)};
  if (!(options.end >= 0 && options.end <= 1))
    return Error{Code::bad_option, "the end of the time looked at is from 0 to 1, not " + shortest(options.end)};
  if (!(options.separation >= 0 && options.separation < kInfinity))
    return Error{Code::bad_option, "the separation is a length, 0 or more, not " + shortest(options.separation)};
  return {};
}

SceneImpacts impacts_of_pairs(std::span<const MovingObject> objects, std::span<const broad::ObjectPair> pairs,
                              const MotionOptions& options) {
  // One frame and height for all, so that each can be walked with each.
  std::vector<motion::BoxPath> ways;
  std::size_t height = 1;
  for (const auto& [vertices, features, cache] : objects)
    if (features != nullptr) {
      ways.push_back(motion::path_of(vertices, features->corners));
      height = std::max(height, motion::PathTree::height_for(features->corners.size()));
    }
  const motion::FloatFrame frame = motion::frame_of(ways);
  motion::ImpactQuery query{.earliest = options.earliest,
                            .end = options.end,
                            .separation = options.separation,
                            .reach = motion::reach_of(options.separation, frame),
                            .limit = options.limit,
                            .for_each = on_threads(options.threads),
                            .stop = options.stop};
  const motion::PathTree::Plan plan{frame, options.end, height, query.for_each, options.stop};
  std::vector<std::optional<motion::PathTree>> trees(objects.size());
  const auto tree_of = [&](std::uint32_t i) -> const motion::PathTree& {
    if (!trees[i]) trees[i].emplace(objects[i].vertices, objects[i].features->corners, objects[i].cache, plan);
    return *trees[i];
  };
  const auto find = [&](const broad::ObjectPair& pair) {
    const MovingObject &a = objects[pair.a], &b = objects[pair.b];
    const motion::MovingMesh first{a.vertices, *a.features, tree_of(pair.a)};
    if (pair.a != pair.b) {
      const motion::MovingMesh second{b.vertices, *b.features, tree_of(pair.b)};
      return motion::find_impacts(first, &second, query);
    }
    std::optional<motion::Features> joined;
    if (options.adjacency == Adjacency::by_position)
      joined = motion::join_equal_vertices(*a.features, a.vertices.from, a.vertices.to, options.stop);
    return motion::find_impacts({a.vertices, joined ? *joined : *a.features, first.tree}, nullptr, query);
  };

  SceneImpacts all;
  for (const broad::ObjectPair& pair : pairs) {
    throw_if_stopped(options.stop);
    if (objects[pair.a].features == nullptr || objects[pair.b].features == nullptr) continue;
    const Impacts found = find(pair);
    all.truncated |= found.truncated;
    const bool is_first = found.earliest && (!all.earliest || sooner(*found.earliest, *all.earliest));
    if (is_first) all.earliest = found.earliest;
    if (options.earliest && is_first) {
      all.objects.clear(), all.offsets.assign(1, 0), all.impacts.clear();
      query.end = found.earliest->hi;  // what is sooner does not end later
    }
    if (found.impacts.empty() || (options.earliest && !is_first)) continue;
    all.objects.push_back({pair.a, pair.b});
    all.impacts.insert(all.impacts.end(), found.impacts.begin(), found.impacts.end());
    all.offsets.push_back(all.impacts.size());
    if (!options.earliest) query.limit = options.limit - all.impacts.size();
  }
  return all;
}

}  // namespace impinge
