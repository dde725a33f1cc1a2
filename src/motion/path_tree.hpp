// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "core/for_each.hpp"
#include "core/shapes.hpp"
#include "motion/box_path.hpp"
#include "motion/features.hpp"

namespace impinge::motion {

/// Takes coordinates to floats between -1 and 1. On each axis no two change their order, so that floats that are apart
/// are so for certain: a difference and a product with a power of two are rounded once each, and so is the float.
struct FloatFrame {
  Vec3 origin{0, 0, 0};
  double scale = 1;
};
FloatFrame frame_of(std::span<const BoxPath> meshes);
/// Floats that are farther apart than this, on one axis, are of coordinates that are so by more than `separation` and
/// its tolerance.
float reach_of(double separation, const FloatFrame& frame);

/// Boxes in the order of their bounds: where a box that moves linearly is at both ends. What is inside at both, and
/// moves linearly, is inside throughout.
inline constexpr int kBounds = 12;  ///< lowest x, y, z and highest ones at the start, then those at the end
inline constexpr int kWidth = 8;
template <int kCount>
struct alignas(kCount % 16 == 0 ? 64 : 32) PathBoxes {
  float bounds[kBounds][kCount];
  /// Holds nothing, and is apart from every box and from itself.
  void clear(int i);
  [[nodiscard]] PathBoxes<1> one(int i) const {
    PathBoxes<1> result;
    for (int k = 0; k < kBounds; ++k) result.bounds[k][0] = bounds[k][i];
    return result;
  }
};

/// A tree over the triangles of a moving mesh until time `end`: eight boxes a node, each of eight triangles or of eight
/// boxes of the level below.
struct PathTree {
  using Node = PathBoxes<kWidth>;

  struct Plan {
    FloatFrame frame;
    double end;
    std::size_t height;  ///< levels, at least as many as the triangles need
    const ForEach& for_each;
    const std::stop_token& stop;
  };
  /// `cache`, if any, tells an order and keeps a better one. Throws `Stopped`.
  PathTree(const Vertices& vertices, std::span<const Corners> corners, FeaturesCache* cache, const Plan& plan);
  static std::size_t height_for(std::size_t triangles);

  /// A vertex in the frame, at the start x, y, z and 0, and so at the end; of one that no triangle has, nothing. The
  /// end may be off by `margin`.
  struct alignas(32) Point {
    static constexpr int kSize = 8, kEnd = 4;
    float at[kSize];
  };
  double end_time;
  float margin;
  std::vector<Point> points;
  std::shared_ptr<const SpatialOrder> order;
  std::vector<std::vector<Node>> levels;  ///< the boxes of node i, but at level 0, are of nodes 8 i to 8 i + 7 below

  /// Those of a box at level 0.
  [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t leaf) const {
    const std::span<const std::uint32_t> all = order->triangles;
    return all.subspan(leaf * kWidth, std::min<std::size_t>(kWidth, all.size() - leaf * kWidth));
  }
  /// Lowest and highest coordinates, not yet with the margin.
  struct Around {
    Point lo, hi;
    /// Written as number i.
    template <int kCount>
    void write(float margin, PathBoxes<kCount>& boxes, int i) const {
      for (int axis = 0; axis < 3; ++axis) {
        boxes.bounds[axis][i] = lo.at[axis], boxes.bounds[3 + axis][i] = hi.at[axis];
        boxes.bounds[6 + axis][i] = lo.at[Point::kEnd + axis] - margin;
        boxes.bounds[9 + axis][i] = hi.at[Point::kEnd + axis] + margin;
      }
    }
    void add(const Around& other) {
      for (int k = 0; k < Point::kSize; ++k)
        lo.at[k] = std::min(lo.at[k], other.lo.at[k]), hi.at[k] = std::max(hi.at[k], other.hi.at[k]);
    }
    /// Along all axes, at both ends.
    [[nodiscard]] double extents() const {
      double sum = 0;
      for (int k = 0; k < Point::kSize; ++k) sum += double{hi.at[k]} - double{lo.at[k]};
      return sum;
    }
  };

 private:
  void add_level(std::size_t boxes);
  /// Returns the looseness.
  double bound_leaves(std::span<const Corners> corners, const ForEach& for_each);
};

template <int kCount>
void PathBoxes<kCount>::clear(int i) {
  for (int k = 0; k < kBounds; ++k) bounds[k][i] = k % 6 < 3 ? 4.0f : -4.0f;
}

}  // namespace impinge::motion
