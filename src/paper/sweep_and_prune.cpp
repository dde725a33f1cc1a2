// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/sweep_and_prune.hpp"

#include <algorithm>

#include "broad/may_touch.hpp"

namespace impinge::paper {
namespace {

// Projections are closed: where one starts at the value at which another ends, they overlap.
bool precedes(const Border& a, const Border& b) {
  return a.value < b.value || (a.value == b.value && a.is_end < b.is_end);
}

void sort_borders(std::vector<Border>& borders) {
  std::size_t moves_left = 16 * borders.size();  // beyond that sorting anew is faster
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const Border border = borders[i];
    std::size_t j = i;
    for (; j > 0 && precedes(border, borders[j - 1]) && moves_left > 0; --j, --moves_left) borders[j] = borders[j - 1];
    borders[j] = border;
    if (moves_left == 0) return std::sort(borders.begin(), borders.end(), precedes);
  }
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

/// The objects whose projections on the sweep's axis hold its present position, in one block of memory.
class OpenObjects {
 public:
  explicit OpenObjects(std::size_t objects) : place_(objects) {}

  void open(std::uint32_t object, const Box& box) {
    place_[object] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({box, object});
  }
  void close(std::uint32_t object) {
    entries_[place_[object]] = entries_.back();
    place_[entries_.back().object] = place_[object];
    entries_.pop_back();
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  template <class Visit>
  void visit_overlapping(const Box& box, const Visit& visit) const {
    for (const Entry& entry : entries_)
      if (overlap(entry.box, box)) visit(entry.object);
  }

 private:
  struct Entry {
    Box box;
    std::uint32_t object;
  };
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> place_;  ///< of an open object in entries_
};

}  // namespace

void SweepAndPrune::update(const scene::SceneView& view) {
  const auto n = static_cast<std::uint32_t>(view.objects.size());
  const auto is_gone = [&](const Border& b) { return b.object >= n || view.objects[b.object].mesh == nullptr; };
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Border>& borders = axes_[axis];
    std::erase_if(borders, is_gone);
    std::vector<bool> known(n);
    for (Border& border : borders) {
      const Box& box = view.objects[border.object].box;
      border.value = component(border.is_end ? box.hi : box.lo, axis);
      known[border.object] = true;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const scene::PlacedObject& object = view.objects[i];
      if (object.mesh == nullptr || known[i]) continue;
      borders.push_back({component(object.box.lo, axis), i, false});
      borders.push_back({component(object.box.hi, axis), i, true});
    }
    sort_borders(borders);
  }
}

broad::ObjectPairs SweepAndPrune::find(const scene::SceneView& view, const std::stop_token& stop,
                                       std::uint64_t* comparisons) const {
  // Along any other axis than the one with the fewest overlaps a thousand pipes side by side would all be open at once.
  const std::array<std::uint64_t, 3> overlaps{count_overlaps(axes_[0]), count_overlaps(axes_[1]),
                                              count_overlaps(axes_[2])};
  const auto axis = std::min_element(overlaps.begin(), overlaps.end()) - overlaps.begin();

  broad::ObjectPairs pairs;
  OpenObjects open(view.objects.size());
  for (const Border& border : axes_[axis]) {
    if (stop.stop_requested()) return {};
    const std::uint32_t object = border.object;
    if (border.is_end) {
      open.close(object);
      continue;
    }
    if (comparisons != nullptr) *comparisons += open.size();
    const Box& box = view.objects[object].box;
    open.visit_overlapping(box, [&](std::uint32_t other) {
      if (!broad::may_touch(view, object, other)) return;
      pairs.push_back({std::min(object, other), std::max(object, other)});
    });
    open.open(object, box);
  }
  std::sort(pairs.begin(), pairs.end(), [](const broad::ObjectPair& p, const broad::ObjectPair& q) {
    return scene::pair_key(p.a, p.b) < scene::pair_key(q.a, q.b);
  });
  return pairs;
}

}  // namespace impinge::paper
