// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/shapes.hpp"

namespace impinge::paper {

/// Two triangles that one of the tests may prove to touch.
struct CandidatePair {
  std::uint32_t id_a, id_b;              ///< mesh triangle ids
  std::uint32_t triangle_a, triangle_b;  ///< in the batch
};

/// An edge of one object against a triangle of the other. The answer counts for each of the (one or two) candidate
/// pairs whose triangle has the edge.
struct ElementTest {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t edge, triangle;
  std::uint32_t first_pair, second_pair;
};

/// The streams of the narrow phase: world vertices, edges and triangles of many leaf pairs, and which to test against
/// which. A candidate pair without tests does not exist: its triangles share no grid cell, or no edge of one meets the
/// other's cells.
struct Batch {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::uint32_t> leaves;  ///< the first edge of each leaf, whose edges follow one another
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<ElementTest> tests;  ///< those with the same triangle follow one another
  std::vector<CandidatePair> pairs;

  [[nodiscard]] Triangle triangle(std::uint32_t i) const {
    const auto& t = triangles[i];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  void clear() { vertices.clear(), edges.clear(), leaves.clear(), triangles.clear(), tests.clear(), pairs.clear(); }
};

/// What certified floating point says of an edge and a triangle, or of two triangles. In order of precedence: a pair of
/// triangles has the greatest verdict of its tests.
enum class Verdict : std::uint8_t {
  no,        ///< certainly apart
  unsure,    ///< left to exact arithmetic
  crossing,  ///< certainly: the edge passes through the interior of the triangle, with an end strictly on either side
};

}  // namespace impinge::paper
