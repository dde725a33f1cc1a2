// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/seen_part.hpp"

/// What is said of two parts follows from their meshes and poses. Assemblies have the same part in the same place more
/// often than one would think: copies that were never moved.
namespace impinge {

/// For each object the first one with equal triangles and an equal pose.
std::vector<std::uint32_t> first_alike(const std::vector<Placed>& objects);

/// Pairs of objects, by their indices, in rows: those in one row are pairs of the same two things.
struct AlikePairs {
  std::vector<std::size_t> rows;   ///< where in `pairs` each begins; and the end of the last
  std::vector<std::size_t> pairs;  ///< in order within a row

  [[nodiscard]] std::size_t size() const { return rows.size() - 1; }
  [[nodiscard]] std::span<const std::size_t> row(std::size_t i) const {
    return std::span(pairs).subspan(rows[i], rows[i + 1] - rows[i]);
  }
};
/// `pairs` are two objects each, the first in the higher half.
AlikePairs alike_pairs(const std::vector<std::uint64_t>& pairs, const std::vector<std::uint32_t>& first_alike);

}  // namespace impinge
