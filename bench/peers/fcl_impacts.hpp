// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace impinge::bench {

/// A vertex and the corners of a face, or the ends of one edge and of another, by their indices.
struct FclFeatures {
  bool on_edges;
  std::array<std::uint32_t, 4> vertices;
};

/// FCL's tests of moving features alone, `Intersect<double>::intersect_VF` and `intersect_EE`, for pairs that are
/// known.
class FclImpacts {
 public:
  /// Coordinates at both ends, x, y, z of each vertex.
  static std::size_t count(const std::vector<double>& from, const std::vector<double>& to,
                           std::span<const FclFeatures> pairs);
};

}  // namespace impinge::bench
