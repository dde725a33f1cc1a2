// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/path_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace impinge::motion {

namespace {

Box hull(const Box& a, const Box& b) { return {min(a.lo, b.lo), max(a.hi, b.hi)}; }
BoxPath hull(const BoxPath& a, const BoxPath& b) { return {hull(a.from, b.from), hull(a.to, b.to)}; }

/// Leaves of a subtree that one task builds.
constexpr std::size_t kTask = 256;

class Builder {
 public:
  Builder(PathTree& tree, const Vertices& vertices, std::span<const Corners> corners, const ForEach& for_each)
      : tree_(tree), vertices_(vertices), corners_(corners), middles_(corners.size()) {
    constexpr std::size_t kBlock = 4096;
    run_each(for_each, (corners.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(corners.size(), (block + 1) * kBlock); ++i) {
        const BoxPath path = path_of(vertices, corners[i]);
        // Halves first, so that nothing overflows; where a triangle is sorted to is a matter of speed alone.
        middles_[i] = 0.25 * path.from.lo + 0.25 * path.from.hi + (0.25 * path.to.lo + 0.25 * path.to.hi);
      }
    });
    std::vector<PathTree::Part> parts{tree.root()};
    // The upper levels one after the other, the rest in parallel.
    std::vector<PathTree::Part> tasks, upper;
    while (!parts.empty()) {
      const PathTree::Part part = parts.back();
      parts.pop_back();
      if (part.leaves <= kTask) {
        tasks.push_back(part);
        continue;
      }
      split(part);
      upper.push_back(part);
      parts.push_back(part.left());
      parts.push_back(part.right());
    }
    run_each(for_each, tasks.size(), [&](std::size_t i) { build(tasks[i]); });
    for (std::size_t i = upper.size(); i-- > 0;) join(upper[i]);
  }

 private:
  void split(const PathTree::Part& part) {
    const auto begin = tree_.triangles.begin() + static_cast<std::ptrdiff_t>(part.first * PathTree::kLeafSize);
    const auto middle = tree_.triangles.begin() + static_cast<std::ptrdiff_t>(part.right().first * PathTree::kLeafSize);
    const auto end =
        tree_.triangles.begin() +
        static_cast<std::ptrdiff_t>(std::min((part.first + part.leaves) * PathTree::kLeafSize, tree_.triangles.size()));
    Vec3 lo = middles_[*begin], hi = lo;
    for (auto i = begin; i != end; ++i) {
      lo = min(lo, middles_[*i]);
      hi = max(hi, middles_[*i]);
    }
    const Vec3 extent = hi - lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::nth_element(begin, middle, end, [&](std::uint32_t i, std::uint32_t j) {
      return component(middles_[i], axis) < component(middles_[j], axis);
    });
  }

  void build(const PathTree::Part& part) {
    if (part.leaves == 1) {
      const auto triangles = tree_.triangles_of(part);
      BoxPath path = path_of(vertices_, corners_[triangles[0]]);
      for (const std::uint32_t triangle : triangles) path = hull(path, path_of(vertices_, corners_[triangle]));
      tree_.nodes[part.node] = path;
      return;
    }
    split(part);
    build(part.left());
    build(part.right());
    join(part);
  }

  void join(const PathTree::Part& part) {
    tree_.nodes[part.node] = hull(tree_.nodes[part.left().node], tree_.nodes[part.right().node]);
  }

  PathTree& tree_;
  const Vertices& vertices_;
  std::span<const Corners> corners_;
  std::vector<Vec3> middles_;
};

// The gap at `end` is off by less than 2^-50 of both gaps: two differences, a difference, a product and a sum, each
// rounded once; 2^-1000 is far more than underflow takes.
bool positive_until(double at0, double at1, double end) {
  if (!(at0 > 0)) return false;
  return at1 > 0 || at0 + end * (at1 - at0) > 0x1p-50 * (at0 + std::abs(at1)) + 0x1p-1000;
}

}  // namespace

BoxPath path_of(const Vertices& vertices, const Corners& c) {
  return {box_of(Triangle{vertices.from[c[0]], vertices.from[c[1]], vertices.from[c[2]]}),
          box_of(Triangle{vertices.to[c[0]], vertices.to[c[1]], vertices.to[c[2]]})};
}

bool stay_apart(const BoxPath& a, const BoxPath& b, double end) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto gap = [&](const Box& low, const Box& high) {
      return component(high.lo, axis) - component(low.hi, axis);
    };
    if (positive_until(gap(a.from, b.from), gap(a.to, b.to), end) ||
        positive_until(gap(b.from, a.from), gap(b.to, a.to), end))
      return true;
  }
  return false;
}

PathTree::PathTree(const Vertices& vertices, std::span<const Corners> corners, const ForEach& for_each) {
  if (corners.empty()) return;
  triangles.resize(corners.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  nodes.resize(2 * root().leaves - 1);
  Builder(*this, vertices, corners, for_each);
}

}  // namespace impinge::motion
