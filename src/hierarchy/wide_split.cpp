// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/wide_split.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "hierarchy/split_plan.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/wide_split.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hierarchy/soup_fit-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

HWY_INLINE void unite(float* box, const Float8& other) { min(Float8::load_aligned(box), other).store_aligned(box); }
HWY_INLINE void unite(float* box, const float* other) { unite(box, Float8::load_aligned(other)); }
HWY_INLINE void clear(float* box) { Float8::all(kEmpty).store_aligned(box); }
HWY_INLINE Float8 as_one(const CornerBox<Float4>& box) { return Float8::of(box.lo, Float4::all(0) - box.hi); }

/// The sum of its corners, twice its centre: what triangles are sorted by.
HWY_INLINE Float4 key_of(const float* box) { return Float4::load_aligned(box) - Float4::load_aligned(box + 4); }

/// Half the surface and a little of the squared extent, so that degenerate boxes on a line differ too.
HWY_INLINE float area_of(const Float8& box) {
  const Float4 size = box.front() + box.back();
  float products[4];
  (size * (size.yzx() + size * Float4::all(0x1p-10f))).store(products);
  return products[0] + products[1] + products[2];
}

SoupFrame fit(const SoupTriangle* triangles, const SoupSample& sample) {
  SoupFrame frame = fit_frame(triangles, sample);
  turn_to_edges(triangles, sample, frame);
  return frame;
}

void make_items(const SoupTriangle* triangles, const SoupSample& sample, const SoupFrame& frame, SplitItem* items) {
  const Rotation<Float8> rotation(frame);
  const std::uint32_t last = sample.size() - 1;
  for (std::uint32_t i = 0; i <= last; i += 2) {
    const std::uint32_t other = std::min(i + 1, last);
    const CornerBox<Float8> boxes = box_of(corners(triangles[sample[i]], triangles[sample[other]]), rotation);
    as_one({boxes.lo.back(), boxes.hi.back()}).store_aligned(items[other].box);
    as_one({boxes.lo.front(), boxes.hi.front()}).store_aligned(items[i].box);
    items[i].box[3] = static_cast<float>(i);
    items[other].box[3] = static_cast<float>(other);
  }
}

struct KeyRange {
  Float4 lo, hi;
};
HWY_INLINE KeyRange range_of(const SplitItem* items, std::uint32_t count) {
  // Two at a time, not to wait for each minimum; the last one may be met twice.
  KeyRange even, odd;
  even.lo = even.hi = odd.lo = odd.hi = key_of(items[count - 1].box);
  for (std::uint32_t i = 0; i + 1 < count; i += 2) {
    const Float4 a = key_of(items[i].box), b = key_of(items[i + 1].box);
    even = {min(even.lo, a), max(even.hi, a)};
    odd = {min(odd.lo, b), max(odd.hi, b)};
  }
  return {min(even.lo, odd.lo), max(even.hi, odd.hi)};
}

/// Bins of equal width along one axis, or two, or three.
struct Bins {
  int size;  ///< of an axis
  int axes;
  std::int32_t axis[4];
  float low[4], per_key[4];
  alignas(32) float box[3][kMostBins][8];
  std::uint32_t count[3][kMostBins];
};

/// Steps across the keys. Axes on which they spread less than a quarter as far as on another are left out: hardly a cut
/// across one of these is ever the best.
HWY_INLINE void lay_out(Bins& bins, const KeyRange& range, std::uint32_t items) {
  bins.size = static_cast<int>(std::clamp<std::uint32_t>(items / 2, kFewestBins, kMostBins));
  bins.axes = 0;
  std::fill_n(bins.axis, 4, 3);
  float low[4], spread[4];
  range.lo.store(low);
  (range.hi - range.lo).store(spread);
  const float most = std::max({spread[0], spread[1], spread[2]});
  for (int axis = 0; axis < 3; ++axis) {
    if (spread[axis] < 0.25f * most || !(spread[axis] > 0x1p-80f)) continue;
    bins.axis[bins.axes] = axis;
    bins.low[bins.axes] = low[axis];
    // The largest key falls into the last bin with 2^-12 to spare.
    bins.per_key[bins.axes++] = static_cast<float>(bins.size) * (1 - 0x1p-12f) / spread[axis];
  }
  for (int a = bins.axes; a < 4; ++a) bins.low[a] = bins.per_key[a] = 0;
}

/// Puts each item in a bin on each axis.
template <int kAxes>
HWY_INLINE void fill(Bins& bins, const SplitItem* items, std::uint32_t count) {
  const int size = bins.size;
  for (int a = 0; a < kAxes; ++a) {
    for (int b = 0; b < size; ++b) clear(bins.box[a][b]), bins.count[a][b] = 0;
  }
  const Float4 low = Float4::load(bins.low), per_key = Float4::load(bins.per_key);
  const Float4::Pick axis(bins.axis);
  std::int32_t bin[4];
  for (std::uint32_t i = 0; i < count; ++i) {
    const float* const box = items[i].box;
    ((key_of(box).picked(axis) - low) * per_key).store_truncated(bin);
    const Float8 own = Float8::load_aligned(box);
    for (int a = 0; a < kAxes; ++a) {
      unite(bins.box[a][bin[a]], own);
      ++bins.count[a][bin[a]];
    }
  }
}

/// The cut of least cost: the sum over both sides of surface times triangles, rounded up to whole leaves, for a leaf
/// that is half empty costs as much as a full one.
HWY_INLINE Cut best_cut(const Bins& bins, const LeafCount& leaves) {
  Cut best;
  int best_axis = 0;
  float least = std::numeric_limits<float>::infinity();
  for (int a = 0; a < bins.axes; ++a) {
    float right_cost[kMostBins];
    Float8 box = Float8::all(kEmpty);
    std::uint32_t count = 0;
    for (int b = bins.size - 1; b > 0; --b) {
      box = min(box, Float8::load_aligned(bins.box[a][b]));
      count += bins.count[a][b];
      right_cost[b] = area_of(box) * leaves(count);
    }
    // The first and the last bin hold something: both sides always do.
    box = Float8::all(kEmpty);
    count = 0;
    for (int b = 1; b < bins.size; ++b) {
      box = min(box, Float8::load_aligned(bins.box[a][b - 1]));
      count += bins.count[a][b - 1];
      const float cost = area_of(box) * leaves(count) + right_cost[b];
      if (cost < least) least = cost, best_axis = a, best.bin = b;
    }
  }
  if (best.bin == 0) return best;
  best.slot = best_axis;
  best.axis = bins.axis[best_axis];
  best.low = bins.low[best_axis], best.per_key = bins.per_key[best_axis];
  return best;
}

/// Stable partition of a range of items at the cut. Returns how many come before it.
HWY_INLINE std::uint32_t part(SplitItem* items, std::uint32_t count, const Cut& cut, SplitItem* scratch) {
  std::uint32_t front = 0, back = 0;
  const float at = static_cast<float>(cut.bin);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float* const box = items[i].box;
    const bool before = (box[cut.axis] - box[cut.axis + 4] - cut.low) * cut.per_key < at;
    const Float8 item = Float8::load_aligned(box);
    item.store_aligned(scratch[back].box);
    item.store_aligned(items[front].box);
    front += before, back += !before;
  }
  std::memcpy(items + front, scratch, back * sizeof(SplitItem));
  return front;
}

/// Splits the largest part that is no leaf, again and again, until there are eight or nothing is left to split.
void make_plan(SplitPlan& plan, SplitItem* items, SplitItem* scratch, const LeafCount& leaves) {
  while (plan.size < kWidth) {
    SplitPart* const whole = plan.largest();
    if (whole == nullptr) return;
    const std::uint32_t count = whole->count;
    SplitItem* const begin = items + whole->first;

    Bins bins;
    lay_out(bins, range_of(begin, count), count);
    switch (bins.axes) {
      case 1:
        fill<1>(bins, begin, count);
        break;
      case 2:
        fill<2>(bins, begin, count);
        break;
      case 3:
        fill<3>(bins, begin, count);
        break;
    }
    const Cut cut = best_cut(bins, leaves);
    if (cut.axis < 0) {
      whole->is_open = false;
      continue;
    }
    plan.cut[plan.cuts] = cut;
    plan.cut_part[plan.cuts++] = static_cast<std::uint8_t>(whole - plan.parts);
    SplitPart& rest = plan.parts[plan.size++];
    whole->count = part(begin, count, cut, scratch);
    rest.first = whole->first + whole->count, rest.count = count - whole->count;
    rest.is_open = true;
    const auto measure = [&](SplitPart& of, int from, int to) HWY_ATTR {
      Float8 box = Float8::all(kEmpty);
      for (int b = from; b < to; ++b) box = min(box, Float8::load_aligned(bins.box[cut.slot][b]));
      box.store_aligned(of.box);
      of.area = area_of(box);
    };
    measure(*whole, 0, cut.bin);
    measure(rest, cut.bin, bins.size);
  }
}

/// The cuts of a plan, seven at once. Nothing lies beyond an unused one.
struct Sieve {
  float low[8] = {}, per_key[8] = {}, bin[8];
  std::int32_t axis[8] = {};
  std::uint8_t part_of[1 << (kWidth - 1)];  ///< by the cuts that a triangle lies beyond

  explicit Sieve(const SplitPlan& plan) {
    std::fill_n(bin, 8, kEmpty);
    for (int k = 0; k < plan.cuts; ++k) {
      const Cut& cut = plan.cut[k];
      low[k] = cut.low, per_key[k] = cut.per_key, bin[k] = static_cast<float>(cut.bin), axis[k] = cut.axis;
    }
    for (unsigned beyond = 0; beyond < 1u << (kWidth - 1); ++beyond) {
      part_of[beyond] = 0;
      for (int k = 0; k < plan.cuts; ++k)
        if (part_of[beyond] == plan.cut_part[k] && (beyond >> k & 1) != 0)
          part_of[beyond] = static_cast<std::uint8_t>(k + 1);
    }
  }
};

/// How many triangles ahead: hardware does not look beyond a page.
constexpr std::size_t kPrefetched = 32;

/// Notes which part each triangle falls into, and how many and what box each part has.
void assign(const SoupTriangle* triangles, std::size_t count, const SoupFrame& frame, const SplitPlan& plan,
            std::uint8_t* parts, SplitTally& tally) {
  const Rotation<Float8> rotation(frame);
  const Sieve sieve(plan);
  const Float4::Pick axis[2] = {Float4::Pick(sieve.axis), Float4::Pick(sieve.axis + 4)};
  const Float4 low[2] = {Float4::load(sieve.low), Float4::load(sieve.low + 4)};
  const Float4 per_key[2] = {Float4::load(sieve.per_key), Float4::load(sieve.per_key + 4)};
  const Float4 bin[2] = {Float4::load(sieve.bin), Float4::load(sieve.bin + 4)};
  const auto part_of = [&](const CornerBox<Float4>& box) HWY_ATTR {
    const Float4 key = box.lo + box.hi;
    const unsigned front = at_least((key.picked(axis[0]) - low[0]) * per_key[0], bin[0]);
    const unsigned back = at_least((key.picked(axis[1]) - low[1]) * per_key[1], bin[1]);
    return sieve.part_of[front | back << 4];
  };
  SplitTally tallies[2];  // neighbours mostly fall into the same part: two tallies halve the chain of additions
  for (SplitTally& each : tallies)
    for (int p = 0; p < kWidth; ++p) clear(each.box[p]), each.count[p] = 0;
  const auto note = [&](std::size_t i, const CornerBox<Float4>& box, SplitTally& own) HWY_ATTR {
    const std::uint8_t p = part_of(box);
    parts[i] = p;
    ++own.count[p];
    unite(own.box[p], as_one(box));
  };
  const std::size_t last = count - 1;
  for (std::size_t i = 0; i <= last; i += 2) {
    hwy::Prefetch(triangles + std::min(i + kPrefetched, last));
    const std::size_t other = std::min(i + 1, last);
    const CornerBox<Float8> boxes = box_of(corners(triangles[i], triangles[other]), rotation);
    note(i, {boxes.lo.front(), boxes.hi.front()}, tallies[0]);
    if (other != i) note(other, {boxes.lo.back(), boxes.hi.back()}, tallies[1]);
  }
  tally = tallies[0];
  for (int p = 0; p < kWidth; ++p) unite(tally.box[p], tallies[1].box[p]), tally.count[p] += tallies[1].count[p];
}

void bound(const SoupTriangle* triangles, std::size_t count, const SoupFrame& frame, float* result) {
  as_one(box_of_all(triangles, count, frame)).store_aligned(result);
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {
HWY_EXPORT(fit);
HWY_EXPORT(make_items);
HWY_EXPORT(make_plan);
HWY_EXPORT(assign);
HWY_EXPORT(bound);
namespace {

// Frames and cuts are chosen by samples of at most so many triangles: of larger ones neither gets better to speak of.
constexpr std::uint32_t kFrameSample = 256, kPlanSample = 1024;
/// What one thread takes on at a time.
constexpr std::size_t kChunk = std::size_t{1} << 15;

/// Working memory for one call; small ranges, which most are, find room on the stack.
template <class T, std::size_t kNear>
class Scratch {
 public:
  explicit Scratch(std::size_t size)
      : far_(size > kNear ? std::make_unique_for_overwrite<T[]>(size) : nullptr), data_(far_ ? far_.get() : near_) {}
  [[nodiscard]] T* data() { return data_; }

 private:
  T near_[kNear];
  std::unique_ptr<T[]> far_;
  T* data_;
};
constexpr std::size_t kSmall = 128;

void add_part(WideSplit& split, std::uint32_t count, const float* box) {
  if (count == 0) return;
  for (int i = 0; i < 3; ++i) split.lo[split.size][i] = box[i], split.hi[split.size][i] = -box[4 + i];
  split.count[split.size++] = count;
}

/// As many triangles in each part, in the order in which they are.
void halve(std::span<SoupTriangle> triangles, WideSplit& split) {
  const std::size_t parts = std::min<std::size_t>(kWidth, triangles.size());
  for (std::size_t p = 0; p < parts; ++p) {
    const std::size_t begin = p * triangles.size() / parts, end = (p + 1) * triangles.size() / parts;
    alignas(64) float box[8];
    HWY_DYNAMIC_DISPATCH(bound)(triangles.data() + begin, end - begin, split.frame, box);
    add_part(split, static_cast<std::uint32_t>(end - begin), box);
  }
}

/// In place: each triangle that is not where it belongs is exchanged with the next one there that does not either.
void deal(std::span<SoupTriangle> triangles, const std::uint8_t* parts, const std::uint32_t (&count)[kWidth]) {
  std::size_t next[kWidth], end[kWidth], sum = 0;
  for (int p = 0; p < kWidth; ++p) next[p] = sum, sum += count[p], end[p] = sum;
  for (std::size_t p = 0; p < kWidth; ++p) {
    for (; next[p] < end[p]; ++next[p]) {
      SoupTriangle triangle = triangles[next[p]];
      std::size_t part = parts[next[p]];
      if (part == p) continue;
      do {
        const std::size_t place = next[part]++;
        std::swap(triangle, triangles[place]);
        part = parts[place];
      } while (part != p);
      triangles[next[p]] = triangle;
    }
  }
}

void split_by_sample(std::span<SoupTriangle> triangles, const SplitPlan& plan, const ForEach& for_each,
                     WideSplit& split) {
  const std::size_t chunks = (triangles.size() + kChunk - 1) / kChunk;
  std::vector<SplitTally> tallies(chunks);
  const auto parts = std::make_unique_for_overwrite<std::uint8_t[]>(triangles.size());
  run_each(for_each, chunks, [&](std::size_t c) {
    const std::size_t begin = c * kChunk, size = std::min(kChunk, triangles.size() - begin);
    HWY_DYNAMIC_DISPATCH(assign)(triangles.data() + begin, size, split.frame, plan, parts.get() + begin, tallies[c]);
  });
  SplitTally all = tallies[0];
  for (std::size_t c = 1; c < chunks; ++c) {
    for (int p = 0; p < kWidth; ++p) {
      all.count[p] += tallies[c].count[p];
      for (int k = 0; k < 8; ++k) all.box[p][k] = std::min(all.box[p][k], tallies[c].box[p][k]);
    }
  }
  deal(triangles, parts.get(), all.count);
  for (int p = 0; p < kWidth; ++p) add_part(split, all.count[p], all.box[p]);
}

void split_by_all(std::span<SoupTriangle> triangles, const SplitPlan& plan, const SplitItem* items,
                  SoupTriangle* scratch, WideSplit& split) {
  for (std::size_t i = 0; i < triangles.size(); ++i) scratch[i] = triangles[items[i].index()];
  std::memcpy(triangles.data(), scratch, triangles.size_bytes());
  for (std::uint32_t first = 0; first < triangles.size();) {
    const SplitPart& part =
        *std::find_if(plan.parts, plan.parts + plan.size, [&](auto& p) { return p.first == first; });
    add_part(split, part.count, part.box);
    first += part.count;
  }
}

}  // namespace

WideSplit split(std::span<SoupTriangle> triangles, const SplitOptions& options, const ForEach& for_each) {
  WideSplit split;
  split.frame = HWY_DYNAMIC_DISPATCH(fit)(triangles.data(), SoupSample(triangles.size(), kFrameSample));
  split.frame.settle(options.base);
  if (options.halve) {
    halve(triangles, split);
    return split;
  }
  const SoupSample sample(triangles.size(), kPlanSample);
  const bool is_whole = sample.size() == triangles.size();
  Scratch<SplitItem, kSmall> items(sample.size()), items_scratch(sample.size());
  Scratch<SoupTriangle, kSmall> scratch(is_whole ? triangles.size() : 0);
  HWY_DYNAMIC_DISPATCH(make_items)(triangles.data(), sample, split.frame, items.data());
  SplitPlan plan;
  plan.most_in_leaf = is_whole ? options.leaf_size : 1;
  plan.parts[0].first = 0, plan.parts[0].count = sample.size(), plan.parts[0].area = 0;
  HWY_DYNAMIC_DISPATCH(make_plan)
  (plan, items.data(), items_scratch.data(), is_whole ? LeafCount(options.leaf_size) : LeafCount());
  if (plan.size == 1) {
    halve(triangles, split);
  } else if (is_whole) {
    split_by_all(triangles, plan, items.data(), scratch.data(), split);
  } else {
    split_by_sample(triangles, plan, for_each, split);
  }
  return split;
}

}  // namespace impinge::hierarchy
#endif  // HWY_ONCE
