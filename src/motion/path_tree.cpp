// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/path_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/number.hpp"
#include "core/stopped.hpp"

namespace impinge::motion {

namespace {

template <class Body>
void in_blocks(const ForEach& for_each, std::size_t size, std::size_t n, const Body& body) {
  run_each(for_each, (n + size - 1) / size, [&](std::size_t block) {
    for (std::size_t i = block * size; i < std::min(n, (block + 1) * size); ++i) body(i);
  });
}

/// Halves ranges of triangles at multiples of eight times a power of two.
class Splitter {
 public:
  Splitter(std::vector<std::uint32_t>& order, std::span<const PathTree::Point> points, std::span<const Corners> corners,
           const ForEach& for_each)
      : order_(order), middles_(corners.size()) {
    in_blocks(for_each, 4096, corners.size(), [&](std::size_t i) {
      const Corners& c = corners[i];
      for (int k = 0; k < 3; ++k) middles_[i][k] = points[c[0]].at[k] + points[c[1]].at[k] + points[c[2]].at[k];
    });
  }

  struct Range {
    std::size_t first, count;
  };
  [[nodiscard]] std::array<Range, 2> split(const Range& range) {
    const std::size_t half = std::bit_ceil(range.count) / 2;
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto middle = begin + static_cast<std::ptrdiff_t>(half);
    const auto end = begin + static_cast<std::ptrdiff_t>(range.count);
    std::array<float, 3> lo = middles_[*begin], hi = lo;
    for (auto i = begin; i != end; ++i)
      for (int k = 0; k < 3; ++k) {
        const float x = middles_[*i][k];
        lo[k] = std::min(lo[k], x), hi[k] = std::max(hi[k], x);
      }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    std::nth_element(begin, middle, end,
                     [&](std::uint32_t i, std::uint32_t j) { return middles_[i][axis] < middles_[j][axis]; });
    return {Range{range.first, half}, Range{range.first + half, range.count - half}};
  }
  void split_all(const Range& range) {
    if (range.count <= kWidth) return;
    for (const Range& part : split(range)) split_all(part);
  }

 private:
  std::vector<std::uint32_t>& order_;
  std::vector<std::array<float, 3>> middles_;
};

/// An order in which the extents are more than so many times what they were is made anew.
constexpr double kLoose = 1.5;

std::vector<std::uint32_t> spatial_order(std::span<const PathTree::Point> points, std::span<const Corners> corners,
                                         const PathTree::Plan& plan) {
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  Splitter splitter(order, points, corners, plan.for_each);
  // The upper levels one after the other, the rest in parallel.
  constexpr std::size_t kTask = 1024;
  std::vector<Splitter::Range> open{{0, order.size()}}, tasks;
  while (!open.empty()) {
    throw_if_stopped(plan.stop);
    const Splitter::Range range = open.back();
    open.pop_back();
    if (range.count <= kTask)
      tasks.push_back(range);
    else
      for (const auto& part : splitter.split(range)) open.push_back(part);
  }
  run_each(plan.for_each, tasks.size(), [&](std::size_t i) {
    throw_if_stopped(plan.stop);
    splitter.split_all(tasks[i]);
  });
  return order;
}

/// Box `i`: those of all of `below`.
void enclose(const PathTree::Node& below, PathTree::Node& boxes, int i) {
  for (int k = 0; k < kBounds; ++k) {
    const auto& row = below.bounds[k];
    boxes.bounds[k][i] = k % 6 < 3 ? *std::min_element(row, row + kWidth) : *std::max_element(row, row + kWidth);
  }
}

}  // namespace

FloatFrame frame_of(std::span<const BoxPath> meshes) {
  Vec3 lo{kInfinity, kInfinity, kInfinity}, hi = -1 * lo;
  for (const BoxPath& mesh : meshes)
    for (const Box& box : {mesh.from, mesh.to}) lo = min(lo, box.lo), hi = max(hi, box.hi);
  if (!(lo.x <= hi.x)) return {};
  const double half = max_component(0.5 * hi - 0.5 * lo);
  return {0.5 * lo + 0.5 * hi, half > 0 ? std::ldexp(1.0, -std::max(exponent(half) + 1, -1000)) : 1};
}

// What comes within the separation and the tolerance (`approach.hpp`, 2^-31 in the frame) is not culled, so that
// answers do not depend on boxes. A difference of two floats below 1 is off by 2^-24, each of them by 2^-25 and 2^-52;
// none is above 2.
float reach_of(double separation, const FloatFrame& frame) {
  if (separation == 0) return 0;
  return static_cast<float>(std::min(separation * frame.scale * (1 + 0x1p-9), 2.0) * (1 + 0x1p-20) + 0x1p-22);
}

// A point in between is computed from two coordinates below 1 and a time, each off by 2^-53 of itself, by three more
// roundings to double and one to float: off by less than 2^-24 + 2^-50. Adding the margin is off by 2^-24 as much.
PathTree::PathTree(const Vertices& vertices, std::span<const Corners> corners, FeaturesCache* cache, const Plan& plan)
    : end_time(plan.end), margin(plan.end < 1 ? 0x1p-22f : 0), points(vertices.from.size()) {
  in_blocks(plan.for_each, 4096, points.size(), [&](std::size_t i) {
    if (i % 4096 == 0) throw_if_stopped(plan.stop);
    const Vec3 from = plan.frame.scale * (vertices.from[i] - plan.frame.origin);
    Vec3 to = plan.frame.scale * (vertices.to[i] - plan.frame.origin);
    if (plan.end < 1) to = from + plan.end * (to - from);
    points[i] = {{static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z), 0,
                  static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z), 0}};
  });
  const auto bound_in_order = [&](std::vector<std::uint32_t> triangles) {
    auto made = std::make_shared<SpatialOrder>(std::move(triangles));
    order = made;
    made->looseness = bound_leaves(corners, plan.for_each);
    if (cache != nullptr) cache->put(order);
  };
  if (cache != nullptr) order = cache->order();
  if (order == nullptr || bound_leaves(corners, plan.for_each) > kLoose * order->looseness)
    bound_in_order(spatial_order(points, corners, plan));
  while (levels.size() < plan.height) {
    throw_if_stopped(plan.stop);
    add_level(levels.back().size());
    const auto& below = levels[levels.size() - 2];
    for (std::size_t i = 0; i < below.size(); ++i)
      enclose(below[i], levels.back()[i / kWidth], static_cast<int>(i % kWidth));
  }
}

void PathTree::add_level(std::size_t boxes) {
  auto& nodes = levels.emplace_back((boxes + kWidth - 1) / kWidth);
  for (int i = 0; i < kWidth; ++i) nodes.back().clear(i);
}

double PathTree::bound_leaves(std::span<const Corners> corners, const ForEach& for_each) {
  const std::size_t boxes = (corners.size() + kWidth - 1) / kWidth;
  levels.clear();
  add_level(boxes);
  std::vector<double> triangle_extents(levels[0].size()), extents_of_eights(levels[0].size());
  in_blocks(for_each, 64, levels[0].size(), [&](std::size_t node) {
    const std::size_t first = node * kWidth, last = std::min(boxes, first + kWidth);
    for (std::size_t i = first; i < last; ++i) {
      Around box;
      std::ranges::fill(box.lo.at, kInfinity), std::ranges::fill(box.hi.at, -kInfinity);
      for (const std::uint32_t triangle : triangles_of(i)) {
        const Corners& c = corners[triangle];
        const Point &p = points[c[0]], &q = points[c[1]], &r = points[c[2]];
        Around next;
        for (int k = 0; k < Point::kSize; ++k) {
          next.lo.at[k] = std::min(std::min(p.at[k], q.at[k]), r.at[k]);
          next.hi.at[k] = std::max(std::max(p.at[k], q.at[k]), r.at[k]);
        }
        triangle_extents[node] += next.extents();
        box.add(next);
      }
      extents_of_eights[node] += box.extents();
      box.write(margin, levels[0][node], static_cast<int>(i - first));
    }
  });
  const auto sum = [](const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); };
  const double whole = sum(triangle_extents);
  return whole > 0 ? sum(extents_of_eights) / whole : 0;
}

std::size_t PathTree::height_for(std::size_t triangles) {
  std::size_t height = 1;
  for (std::size_t n = kWidth * kWidth; n < triangles; n *= kWidth) ++height;
  return height;
}

}  // namespace impinge::motion
