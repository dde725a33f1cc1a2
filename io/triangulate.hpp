// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// Polygons cut into triangles, the same way for every reader.
namespace impinge::io {

/// Cuts polygons of one vertex array. A polygon of n corners becomes n - 2 triangles on its own corners, in its own
/// orientation (none if n < 3):
/// - a convex or flat (zero-area) polygon becomes a fan from its first corner;
/// - any other has ears cut off, judged exactly on its projection along the largest component of its Newell normal: in
///   rounds from corner to corner, and after each ear its two neighbours once more at the round's end. An ear turns
///   strictly and no other corner lies in it; a simple polygon has one until three corners are left. A corner straight
///   in between two others is cut only after a round without an ear, and makes a triangle without area;
/// - where no ear is left (the outline crosses itself), or past the work limit, what remains becomes a fan and the
///   polygon is counted by `fanned`.
/// Corners are looked up in a grid, so an ear usually costs a handful of tests; the work limit bounds the worst case
/// to a few seconds a vertex array.
class Triangulator {
 public:
  explicit Triangulator(std::span<const double> xyz, std::uint64_t work_limit = 100'000'000)
      : xyz_(xyz), work_left_(work_limit) {}

  /// Appends three indices a triangle. Every corner must be the index of a vertex.
  void append(std::span<const std::uint32_t> polygon, std::vector<std::uint32_t>& triangles);

  /// How many concave polygons were not cut into ears to the end.
  [[nodiscard]] std::uint64_t fanned() const { return fanned_; }

 private:
  /// Corners of the current polygon in its projection plane, so turned that it runs counter-clockwise.
  struct Corner {
    double u, v;
    std::uint32_t previous, next;
    bool blocks;  ///< may lie in an ear: it does not turn strictly to the left
    bool is_cut;
  };
  struct Grid {
    double u0 = 0, v0 = 0, per_u = 0, per_v = 0;
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::uint32_t> starts, corners;
  };

  bool project(std::span<const std::uint32_t> polygon);
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool is_convex() const;
  void build_grid();
  [[nodiscard]] std::uint32_t column(double u) const;
  [[nodiscard]] std::uint32_t row(double v) const;
  [[nodiscard]] bool is_ear(std::uint32_t corner);
  [[nodiscard]] bool is_in_ear(std::uint32_t p, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  void cut_ears(std::span<const std::uint32_t> polygon, std::vector<std::uint32_t>& triangles);
  void collect_candidates(std::uint32_t start, std::size_t left);
  bool find_flat(std::uint32_t start, std::size_t left, std::uint32_t& found);
  void unlink(std::uint32_t corner);
  void spend(std::uint64_t work) { work_left_ -= work < work_left_ ? work : work_left_; }

  std::span<const double> xyz_;
  std::uint64_t work_left_;
  std::uint64_t fanned_ = 0;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> candidates_;  ///< corners that may have become ears, in the order in which they did
  Grid grid_;
};

}  // namespace impinge::io
