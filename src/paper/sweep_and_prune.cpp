// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/sweep_and_prune.hpp"

#include <algorithm>
#include <bit>

#include "broad/may_touch.hpp"

namespace impinge::paper {
namespace {

// Projections are closed: where one starts at the value at which another ends, they overlap.
bool precedes(const Border& a, const Border& b) {
  return a.value < b.value || (a.value == b.value && a.is_end < b.is_end);
}

/// How many pairs of projections overlap on an axis.
std::uint64_t count_overlaps(const std::vector<Border>& borders) {
  std::uint64_t open = 0, overlaps = 0;
  for (const Border& border : borders) {
    if (border.is_end)
      --open;
    else
      overlaps += open++;
  }
  return overlaps;
}

}  // namespace

void SweepAndPrune::sort(std::vector<Border>& borders) {
  const std::size_t most_moves = 64 * borders.size();  // beyond that sorting anew is faster
  std::size_t moves = 0;
  for (std::size_t i = 1; i < borders.size() && moves < most_moves; ++i) {
    const Border border = borders[i];
    std::size_t j = i;
    for (; j > 0 && precedes(border, borders[j - 1]); --j, ++moves) borders[j] = borders[j - 1];
    borders[j] = border;
  }
  counts_.moves += moves;
  if (moves < most_moves) return;
  std::sort(borders.begin(), borders.end(), precedes);
  counts_.moves += borders.size() * std::bit_width(borders.size());
}

void SweepAndPrune::update(const scene::SceneView& view) {
  const auto n = static_cast<std::uint32_t>(view.objects.size());
  const auto is_gone = [&](const Border& b) { return b.object >= n || view.objects[b.object].mesh == nullptr; };
  counts_ = {};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Border>& borders = axes_[axis];
    std::erase_if(borders, is_gone);
    borders.reserve(2 * std::size_t{n});  // so that no object is ever left with one border if memory runs out
    places_.assign(n, 0);
    for (Border& border : borders) {
      const Box& box = view.objects[border.object].box;
      border.value = component(border.is_end ? box.hi : box.lo, axis);
      places_[border.object] = 1;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const scene::PlacedObject& object = view.objects[i];
      if (object.mesh == nullptr || places_[i] != 0) continue;
      borders.push_back({component(object.box.lo, axis), i, false});
      borders.push_back({component(object.box.hi, axis), i, true});
    }
    sort(borders);
  }
  counts_.updated = axes_[0].size() / 2;
}

void SweepAndPrune::find(const scene::SceneView& view, broad::ObjectPairs& pairs, const std::stop_token& stop) {
  // Along any other axis than the one with the fewest overlaps a thousand pipes side by side would all be open at once.
  const std::array<std::uint64_t, 3> overlaps{count_overlaps(axes_[0]), count_overlaps(axes_[1]),
                                              count_overlaps(axes_[2])};
  const auto axis = std::min_element(overlaps.begin(), overlaps.end()) - overlaps.begin();

  pairs.clear(), open_.clear();
  places_.resize(view.objects.size());
  for (const Border& border : axes_[axis]) {
    if (stop.stop_requested()) return pairs.clear();
    const std::uint32_t object = border.object;
    if (border.is_end) {
      open_[places_[object]] = open_.back();
      places_[open_.back().object] = places_[object];
      open_.pop_back();
      continue;
    }
    counts_.sphere_tests += open_.size();
    const Box& box = view.objects[object].box;
    for (const Open& other : open_)
      if (overlap(other.box, box) && broad::may_touch(view, object, other.object))
        pairs.push_back({std::min(object, other.object), std::max(object, other.object)});
    places_[object] = static_cast<std::uint32_t>(open_.size());
    open_.push_back({box, object});
  }
  std::sort(pairs.begin(), pairs.end(), [](const broad::ObjectPair& p, const broad::ObjectPair& q) {
    return scene::pair_key(p.a, p.b) < scene::pair_key(q.a, q.b);
  });
}

}  // namespace impinge::paper
