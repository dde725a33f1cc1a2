// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "broad/near_pairs.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <utility>

#include "broad/may_touch.hpp"

namespace impinge::broad {
namespace {

// Found by trial on crowds that drift, swing and jitter by 0.25 to 5 % of their size a frame. More room: fewer objects
// leave theirs, but more candidates overlap in vain.
constexpr double kFramesAhead = 24;     ///< room in the direction of motion
constexpr double kFramesAround = 10;    ///< room on all sides, for turns and jitter
constexpr double kMostRoom = 0.25;      ///< of the extent along the axis: thin things side by side stay apart
constexpr double kRoomAtRest = 0x1p-5;  ///< of the extent, for an object that has not moved yet
constexpr double kShareToBuild = 0.5;   ///< of the population: so many changes make building anew faster

// An object that leaves its box in the first frame so often jumps, until it is found in the same box twice; they are
// looked at every so many frames. No more than so many jump, as each query looks each of them up.
constexpr std::uint32_t kShortLived = 2, kFramesToRest = 8;
constexpr std::size_t kMostJumping = 16;

constexpr std::size_t kChunk = 512;         ///< candidates that are filtered together, in cache
constexpr std::size_t kChangedPart = 1024;  ///< changed objects that are worth the hand-over to another thread
constexpr std::size_t kPart = 32768;        ///< candidates that are worth the hand-over to another thread
constexpr std::size_t kPrefetch = 24;       ///< candidates that the objects of one take to arrive from memory

std::uint32_t first_of(std::uint64_t pair) { return static_cast<std::uint32_t>(pair >> 32); }
std::uint32_t second_of(std::uint64_t pair) { return static_cast<std::uint32_t>(pair); }

}  // namespace

void NearPairs::reserve(std::size_t n) {
  changed_.reserve(n);  // a copy's is shorter
  if (n <= boxes_.size()) return;
  assert(n < kObjectBit);
  has_changed_.resize(n), is_here_.resize(n), is_jumping_.resize(n);
  jumping_.reserve(kMostJumping);
  groups_.resize(n), starts_.resize(n), spheres_.resize(n), fat_boxes_.resize(n);
  boxes_.resize(n);  // last: its size is what the others have at least
}

void NearPairs::place(std::uint32_t object, const scene::PlacedObject& placed) noexcept {
  assert(object < boxes_.size());
  const bool is_here = placed.mesh != nullptr && placed.in_domain, was_here = is_here_[object] != 0;
  boxes_[object] = placed.box;
  spheres_[object] = placed.sphere;
  const bool is_same = was_here && groups_[object] == placed.group;
  const bool jumps = is_jumping_[object] != 0 && has_changed_[object] == 0;
  const bool stays = is_same && (jumps || contains(fat_boxes_[object], placed.box));
  if (is_here == was_here && (stays || !is_here)) return;
  if (std::exchange(has_changed_[object], 1) == 0) changed_.push_back(object);
  is_here_[object] = is_here ? 1 : 0;
  groups_[object] = placed.group;
  if (was_here) --population_;
  if (!is_here) return;
  ++population_;
  Start& start = starts_[object];
  const std::uint32_t age = frame_ - start.frame;  // 0: moved twice in this frame, which says nothing of the next
  const std::uint32_t short_lived = !is_same || age > 1 ? 0 : start.short_lived + age;
  fat_boxes_[object] = fat_box(object, !was_here);
  start = {placed.box.lo + placed.box.hi, frame_, short_lived};
}

Box NearPairs::fat_box(std::uint32_t object, bool is_new) const {
  const Box& box = boxes_[object];
  const Vec3 extent = box.hi - box.lo;
  // From 3/4 to 5/4, so that objects that started together do not all leave their boxes in the same frame.
  const double luck = 0.75 + 0x1p-33 * ((object + frame_ * 40503u) * 2654435761u);
  if (is_new) {
    const Vec3 around = (luck * kRoomAtRest) * extent;
    return {box.lo - around, box.hi + around};
  }
  const Start& start = starts_[object];
  const double age = std::max(1u, frame_ - start.frame);
  const Vec3 motion = (0.5 / age) * ((box.lo + box.hi) - start.twice_middle);
  const double around = luck * kFramesAround * max_component(abs(motion));
  const auto room = [&](int axis, double direction) {
    const double ahead = direction * luck * kFramesAhead * component(motion, axis);
    return std::min(around + std::max(0.0, ahead), kMostRoom * component(extent, axis));
  };
  return {box.lo - Vec3{room(0, -1), room(1, -1), room(2, -1)}, box.hi + Vec3{room(0, 1), room(1, 1), room(2, 1)}};
}

/// Lets changed objects jump, and those that did and are not where or what they were no longer.
void NearPairs::find_jumping() {
  std::erase_if(jumping_, [&](std::uint32_t object) {
    if (has_changed_[object] != 0) is_jumping_[object] = 0;
    return has_changed_[object] != 0;
  });
  for (const std::uint32_t object : changed_) {
    if (jumping_.size() == kMostJumping) break;
    if (is_here_[object] == 0 || starts_[object].short_lived < kShortLived) continue;
    jumping_.push_back(object);
    is_jumping_[object] = 1;
  }
}

/// Objects that jumped and have come to rest are to go back into the tree.
void NearPairs::put_back() {
  if (frame_ % kFramesToRest != 0) return;
  for (const std::uint32_t object : jumping_) {
    if (has_changed_[object] != 0) continue;
    if (!contains(fat_boxes_[object], boxes_[object])) {
      fat_boxes_[object] = fat_box(object, true);
      starts_[object] = {boxes_[object].lo + boxes_[object].hi, frame_, 0};
    } else {
      starts_[object].short_lived = 0;
      has_changed_[object] = 1;
      changed_.push_back(object);
    }
  }
}

void NearPairs::update(const ForEach& for_each) {
  ++frame_;
  put_back();
  if (is_current()) return;
  find_jumping();
  const bool much = static_cast<double>(changed_.size()) > kShareToBuild * population_;
  if (std::exchange(must_build_, true) || much)
    build();
  else
    repair(for_each);
  for (const std::uint32_t object : changed_) has_changed_[object] = 0;
  changed_.clear();
  entries_.clear(), fresh_.clear(), sorted_.clear();  // a copy has no use for them
  must_build_ = false;
}

void NearPairs::build() {
  build_tree();
  searches_.resize(std::max<std::size_t>(searches_.size(), 1));
  BoxTree::Search& search = searches_[0];
  tree_.find_pairs(fat_boxes_, groups_, search);
  search.found.swap(fresh_);
  box_tests_ += search.box_tests;
  sort_fresh();
  candidates_.swap(sorted_);
}

void NearPairs::build_tree() {
  entries_.clear();
  for (std::uint32_t i = 0; i < boxes_.size(); ++i)
    if (is_here_[i] != 0 && is_jumping_[i] == 0) entries_.emplace_back(fat_boxes_[i], i);
  tree_.build(entries_);
}

void NearPairs::repair(const ForEach& for_each) {
  for (const std::uint32_t object : changed_) {
    if (is_here_[object] != 0 && is_jumping_[object] == 0)
      tree_.put(object, fat_boxes_[object]);
    else
      tree_.remove(object);
  }
  tree_.refit();
  if (tree_.is_worn()) build_tree();
  find_fresh(for_each);
  sort_fresh();
  merge_fresh();
}

/// The pairs of changed objects with all others.
void NearPairs::find_fresh(const ForEach& for_each) {
  const std::size_t parts = for_each ? changed_.size() / kChangedPart + 1 : 1;
  if (searches_.size() < parts) searches_.resize(parts);
  const auto find_part = [&](std::size_t part) {
    const std::size_t begin = part * changed_.size() / parts, end = (part + 1) * changed_.size() / parts;
    BoxTree::Search& search = searches_[part];
    tree_.find(std::span(changed_).subspan(begin, end - begin), fat_boxes_, search);
    // Of two changed objects, the lower one reports the pair.
    std::erase_if(search.found, [&](std::uint64_t pair) {
      const std::uint32_t changed = first_of(pair), other = second_of(pair);
      const bool comes_again = other < changed && has_changed_[other] != 0;
      const bool one_group = groups_[changed] != 0 && groups_[changed] == groups_[other];
      return is_here_[changed] == 0 || is_jumping_[changed] != 0 || changed == other || comes_again || one_group;
    });
  };
  run_each(for_each, parts, find_part);
  fresh_.clear();
  for (std::size_t part = 0; part < parts; ++part) {
    box_tests_ += searches_[part].box_tests;
    for (const std::uint64_t pair : searches_[part].found)
      fresh_.push_back(scene::pair_key(first_of(pair), second_of(pair)));
  }
}

/// Sorts pairs into rows by the lower object, then each row: linear, as rows are short. A few pairs are sorted
/// directly, which costs less than counting all rows.
void NearPairs::sort_fresh() {
  if (fresh_.size() < boxes_.size() / 32) {
    sorted_.swap(fresh_);
    std::sort(sorted_.begin(), sorted_.end());
    return;
  }
  row_ends_.assign(boxes_.size() + 1, 0);
  for (const std::uint64_t pair : fresh_) ++row_ends_[first_of(pair) + 1];
  for (std::size_t i = 1; i < row_ends_.size(); ++i) row_ends_[i] += row_ends_[i - 1];
  sorted_.resize(fresh_.size());
  for (const std::uint64_t pair : fresh_) sorted_[row_ends_[first_of(pair)]++] = pair;
  auto row = sorted_.begin();
  for (const std::uint32_t end : row_ends_) {
    const auto next = sorted_.begin() + end;
    if (next - row > 1) std::sort(row, next);
    row = next;
  }
}

/// Drops the candidates of changed objects and takes the sorted ones in.
void NearPairs::merge_fresh() {
  merged_.resize(candidates_.size() + sorted_.size());
  const std::uint64_t *old = candidates_.data(), *const end = old + candidates_.size();
  const std::uint8_t* const has_changed = has_changed_.data();
  std::uint64_t* out = merged_.data();
  const auto keep_below = [&](std::uint64_t limit) {
    for (; old != end && *old < limit; ++old) {
      *out = *old;
      out += (has_changed[first_of(*old)] | has_changed[second_of(*old)]) == 0 ? 1 : 0;
    }
  };
  for (const std::uint64_t pair : sorted_) {
    keep_below(pair);
    *out++ = pair;
  }
  keep_below(~std::uint64_t{0});
  merged_.resize(static_cast<std::size_t>(out - merged_.data()));
  candidates_.swap(merged_);
}

void NearPairs::find_near(const Box& box, BoxTree::Search& search) const {
  constexpr std::array<std::uint32_t, 1> kOne{0};
  find_resting(kOne, {&box, 1}, search);
  for (const std::uint32_t object : jumping_)
    if (overlap(box, boxes_[object])) search.found.push_back(object);
}

std::size_t NearPairs::find(const scene::SceneView& view, ObjectPairs& pairs, Scratch& scratch,
                            const FindConfig& config) const {
  const std::size_t n = candidates_.size(), parts = config.for_each ? n / kPart + 1 : 1;
  // Each part writes the candidates that it keeps from where its own begin; behind all candidates stand the counts.
  scratch.kept.resize(n + parts);
  const auto begin = [&](std::size_t part) { return part * n / parts; };
  std::uint64_t *const kept = scratch.kept.data(), *const counts = kept + n;
  run_each(config.for_each, parts, [&](std::size_t part) {
    counts[part] = filter(view, begin(part), begin(part + 1), config.stop, kept + begin(part));
  });
  if (config.stop.stop_requested()) return pairs.clear(), 0;
  pairs.resize(std::accumulate(counts, counts + parts, std::size_t{0}));
  run_each(config.for_each, parts, [&](std::size_t part) {
    const std::size_t before = std::accumulate(counts, counts + part, std::size_t{0});
    std::transform(kept + begin(part), kept + begin(part) + counts[part], pairs.data() + before,
                   [](std::uint64_t pair) {
                     return ObjectPair{first_of(pair), second_of(pair)};
                   });
  });
  if (jumping_.empty()) return n;
  find_resting(jumping_, boxes_, scratch.jumping);
  for (std::size_t i = 0; i < jumping_.size(); ++i) {
    const Sphere& sphere = spheres_[jumping_[i]];
    for (std::size_t k = i + 1; k < jumping_.size(); ++k)
      if (spheres_meet(sphere, spheres_[jumping_[k]]))
        scratch.jumping.found.push_back(scene::pair_key(jumping_[i], jumping_[k]));
  }
  const std::size_t looked_up = scratch.jumping.found.size();
  add_jumping(view, pairs, scratch.jumping);
  return n + looked_up;
}

/// Adds the pairs among those that were looked up.
void NearPairs::add_jumping(const scene::SceneView& view, ObjectPairs& pairs, BoxTree::Search& search) const {
  std::vector<std::uint64_t>& found = search.found;
  std::erase_if(found, [&](std::uint64_t pair) {
    const std::uint32_t a = first_of(pair), b = second_of(pair);
    const bool one_group = groups_[a] != 0 && groups_[a] == groups_[b];
    return one_group || !spheres_meet(spheres_[a], spheres_[b]) || !overlap(boxes_[a], boxes_[b]) ||
           (view.ignored != nullptr && view.ignored->contains(a, b));
  });
  for (std::uint64_t& pair : found) pair = scene::pair_key(first_of(pair), second_of(pair));
  std::sort(found.begin(), found.end());
  // Merged from behind, in place.
  std::size_t old = pairs.size(), added = found.size(), to = old + added;
  pairs.resize(to);
  while (added > 0) {
    const bool is_old = old > 0 && scene::pair_key(pairs[old - 1].a, pairs[old - 1].b) > found[added - 1];
    pairs[--to] = is_old ? pairs[--old] : ObjectPair{first_of(found[added - 1]), second_of(found[added - 1])};
    added -= is_old ? 0 : 1;
  }
}

/// Puts those of these candidates that stay into `kept` and returns how many they are.
std::size_t NearPairs::filter(const scene::SceneView& view, std::size_t begin, std::size_t end,
                              const std::stop_token& stop, std::uint64_t* kept) const {
  const bool any_ignored = view.ignored != nullptr && !view.ignored->empty();
  std::uint64_t* const first = kept;
  for (; begin < end && !stop.stop_requested(); begin += kChunk) {
    // A sphere is the tighter bound of most things, and less to read. Which pairs stay is as good as random: the counts
    // are raised without a branch.
    const std::size_t chunk_end = std::min(begin + kChunk, end);
    std::size_t meeting = 0;
    for (std::size_t i = begin; i < chunk_end; ++i) {
      const std::uint64_t pair = candidates_[i], soon = candidates_[std::min(i + kPrefetch, end - 1)];
      hwy::Prefetch(&spheres_[second_of(soon)]);
      kept[meeting] = pair;
      meeting += spheres_meet(spheres_[first_of(pair)], spheres_[second_of(pair)]) ? 1 : 0;
    }
    std::size_t overlapping = 0;
    for (std::size_t i = 0; i < meeting; ++i) {
      const std::uint64_t pair = kept[i];
      const Box& soon = boxes_[second_of(kept[std::min(i + kPrefetch, meeting - 1)])];
      hwy::Prefetch(&soon.lo), hwy::Prefetch(&soon.hi.z);  // a box may lie across two lines
      kept[overlapping] = pair;
      overlapping += overlap(boxes_[first_of(pair)], boxes_[second_of(pair)]) ? 1 : 0;
    }
    std::uint64_t* const kept_end = kept + overlapping;
    const auto is_ignored = [&](std::uint64_t pair) { return view.ignored->contains(first_of(pair), second_of(pair)); };
    kept = any_ignored ? std::remove_if(kept, kept_end, is_ignored) : kept_end;
  }
  return static_cast<std::size_t>(kept - first);
}

}  // namespace impinge::broad
