// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "broad/box_area.hpp"
#include "broad/box_tree.hpp"

namespace impinge::broad {
namespace {

using Least = std::array<double, 6>;
constexpr Least kNone{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};

Box to_box(const Least& least) { return {{least[0], least[1], least[2]}, {-least[3], -least[4], -least[5]}}; }

}  // namespace

/// A run of entries that becomes a child, with the bounds of their boxes and those of their doubled centres.
struct BoxTree::Run {
  std::span<Entry> entries;
  Least box = kNone, middles = kNone;

  void measure() {
    Least b = kNone, m = kNone;
    for (const Entry& entry : entries) {
      for (int i = 0; i < 6; ++i) b[i] = std::min(b[i], entry.least[i]);
      for (int i = 0; i < 3; ++i) {
        const double middle = entry.least[i] - entry.least[i + 3];
        m[i] = std::min(m[i], middle), m[i + 3] = std::min(m[i + 3], -middle);
      }
    }
    box = b, middles = m;
  }
  [[nodiscard]] double extent(int axis) const { return -box[axis + 3] - box[axis]; }
  [[nodiscard]] double spread(int axis) const { return -middles[axis + 3] - middles[axis]; }
};

namespace {

using Run = BoxTree::Run;

constexpr int kMostBins = 16;
constexpr std::size_t kSample = 256;   ///< entries by which the plane that splits a long run is chosen
constexpr std::size_t kOneAxis = 256;  ///< in shorter runs only the promising axis is tried

struct Bin {
  Least least = kNone;
  std::size_t count = 0;

  void add(const Least& other, std::size_t n) {
    for (int i = 0; i < 6; ++i) least[i] = std::min(least[i], other[i]);
    count += n;
  }
  /// Its area times the nodes that its entries fill: a run that fits a node is not split for a few.
  [[nodiscard]] double cost() const {
    const std::size_t nodes = (count + kTreeWidth - 1) / kTreeWidth;
    return half_area(to_box(least)) * static_cast<double>(nodes);
  }
};

/// Planes across an axis that cut the range of the middles into bins.
struct Planes {
  Planes(const Run& run, int along)
      : axis(along),
        bins(static_cast<int>(std::min<std::size_t>(kMostBins, 4 + run.entries.size() / 8))),
        least(run.middles[along]),
        scale(bins / run.spread(along)) {}

  [[nodiscard]] int bin(const BoxTree::Entry& entry) const {
    const double at = (entry.least[axis] - entry.least[axis + 3] - least) * scale;
    return at < bins - 1 ? static_cast<int>(at) : bins - 1;  // whatever rounding or an overflow made of it
  }

  int axis, bins;
  double least, scale;
};

struct Choice {
  int axis = 0, first_right_bin = 0;  ///< 0: no plane splits the run
  double cost = kInfinity;
};

/// Judged by every stride-th entry.
Choice best_plane(const Run& run, const Planes& planes, std::size_t stride) {
  std::array<Bin, kMostBins> bins;
  for (std::size_t i = 0; i < run.entries.size(); i += stride)
    bins[planes.bin(run.entries[i])].add(run.entries[i].least, stride);

  std::array<double, kMostBins> right_cost;
  Bin left, right;
  for (int i = planes.bins - 1; i > 0; --i) {
    right.add(bins[i].least, bins[i].count);
    right_cost[i] = right.count == 0 ? kInfinity : right.cost();
  }
  Choice best{planes.axis};
  for (int i = 1; i < planes.bins; ++i) {
    left.add(bins[i - 1].least, bins[i - 1].count);
    if (left.count == 0) continue;
    if (const double cost = left.cost() + right_cost[i]; cost < best.cost) best = {planes.axis, i, cost};
  }
  return best;
}

/// Halving the spread of the middles along this axis takes most of the area away.
int promising_axis(const Run& run) {
  int best = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double gain = run.spread(axis) * (run.extent((axis + 1) % 3) + run.extent((axis + 2) % 3));
    if (gain > most) most = gain, best = axis;
  }
  return best;
}

Choice best_plane(const Run& run) {
  if (run.entries.size() <= kOneAxis) return best_plane(run, {run, promising_axis(run)}, 1);
  Choice best;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(run.spread(axis) > 0)) continue;
    const Planes planes(run, axis);
    const Choice choice = best_plane(run, planes, 1 + run.entries.size() / kSample);
    if (choice.cost < best.cost) best = choice;
    if (choice.first_right_bin > 0) continue;
    // The whole sample is in one bin. If some entry is not, the sample missed a few outliers, which are split off
    // first.
    if (const Choice of_all = best_plane(run, planes, 1); of_all.first_right_bin > 0) return of_all;
  }
  return best;
}

/// Splits a run of at least two entries in two, neither of them empty.
std::array<Run, 2> split(const Run& run) {
  std::size_t left = run.entries.size() / 2;
  if (const Choice choice = best_plane(run); choice.first_right_bin > 0) {
    const Planes planes(run, choice.axis);
    const auto is_left = [&](const BoxTree::Entry& entry) { return planes.bin(entry) < choice.first_right_bin; };
    const auto end = std::partition(run.entries.begin(), run.entries.end(), is_left);
    left = static_cast<std::size_t>(end - run.entries.begin());
  }
  std::array<Run, 2> parts{Run{run.entries.first(left)}, Run{run.entries.subspan(left)}};
  for (Run& part : parts) part.measure();
  return parts;
}

}  // namespace

void BoxTree::build(std::span<Entry> entries) {
  clear();
  nodes_.reserve(entries.size() / 4);
  Run all{entries};
  all.measure();
  build_node(0, all);
  if (!entries.empty()) set_bounds(0, to_box(all.box));
  built_objects_ = entries.size(), inserts_ = 0;
}

void BoxTree::build_node(std::uint32_t node, const Run& run) {
  if (run.entries.size() <= kTreeWidth) {
    for (int i = 0; const Entry& entry : run.entries) hold(node, i++, entry.object, to_box(entry.least));
    return;
  }
  std::array<Run, kTreeWidth> parts{run};
  int made = 1;
  for (; made < kTreeWidth; ++made) {
    int largest = -1;
    double most = -1;
    for (int i = 0; i < made; ++i) {
      if (parts[i].entries.size() <= kTreeWidth) continue;
      if (const double area = half_area(to_box(parts[i].box)); area > most) most = area, largest = i;
    }
    if (largest < 0) break;
    const auto halves = split(parts[largest]);
    parts[largest] = halves[0], parts[made] = halves[1];
  }
  for (int i = 0; i < made; ++i) {
    const auto entries = parts[i].entries;
    if (entries.size() == 1) {
      hold(node, i, entries[0].object, to_box(entries[0].least));
      continue;
    }
    const std::uint32_t child = make_node(node, i);
    set_bounds(child, to_box(parts[i].box));
    build_node(child, parts[i]);
  }
}

}  // namespace impinge::broad
