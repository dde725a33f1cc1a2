// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/part.hpp"

/// Groups candidate pairs whose meshes and poses are equal: one verdict serves the whole group. Assemblies
/// often hold copies of a part that were never moved from its place.
namespace impinge {

/// For each object the index of the first object with an equal mesh and an equal pose.
std::vector<std::uint32_t> first_equal(const std::vector<Placed>& objects);

/// Indices of candidate pairs in rows; the pairs of one row have equal meshes and poses.
struct EqualPairs {
  std::vector<std::size_t> rows;   ///< where each row begins in `pairs`, and where the last one ends
  std::vector<std::size_t> pairs;  ///< indices of candidates, ascending within a row

  [[nodiscard]] std::size_t size() const { return rows.size() - 1; }
  [[nodiscard]] std::span<const std::size_t> row(std::size_t i) const {
    return std::span(pairs).subspan(rows[i], rows[i + 1] - rows[i]);
  }
};
/// Each of `pairs` holds the indices of two objects, the first in the higher half.
EqualPairs group_equal_pairs(const std::vector<std::uint64_t>& pairs, const std::vector<std::uint32_t>& first_equal);

}  // namespace impinge
