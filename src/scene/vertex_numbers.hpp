// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/shapes.hpp"

namespace impinge::scene {

/// What is read off vertices in one pass.
struct VertexNumbers {
  static constexpr std::size_t kRun = 64;

  bool is_finite = true;          ///< if not, nothing else here holds
  std::vector<Box> boxes;         ///< of each kRun vertices that follow each other, and of the rest
  double least = kInfinity;       ///< the smallest |coordinate| beside 0
  double last_place = kInfinity;  ///< 2^e for the largest e such that all coordinates are multiples of it

  [[nodiscard]] Box box() const;  ///< of all; there are some
};
[[nodiscard]] VertexNumbers vertex_numbers(std::span<const Vec3> vertices);

/// Of |scale (p - middle) - center|² over all points, as computed for each in double; of none, 0.
[[nodiscard]] double greatest_square(std::span<const Vec3> points, const Vec3& middle, double scale,
                                     const Vec3& center);

/// The vertices' part of a mesh's hash (docs/hash.md).
[[nodiscard]] std::uint64_t vertex_hash(std::span<const Vec3> vertices);

}  // namespace impinge::scene
