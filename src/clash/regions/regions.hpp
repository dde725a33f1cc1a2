// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/for_each.hpp"
#include "exact/contact.hpp"
#include "impinge/regions.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// One of the two bodies whose contact is looked at.
struct Side {
  const solid::Body& body;
  std::span<const std::uint32_t> position;  ///< per mesh vertex: equal world coordinates have equal numbers, from 0
  std::uint32_t positions = 0;              ///< how many
  /// Whether a point lies in the interior of what the body encloses, not on its boundary. Empty: it encloses nothing,
  /// and joins no regions of contact.
  std::function<bool(const Vec3&)> holds;
  /// Per triangle, whether its normal (by its order of vertices) looks into the interior. Empty: none does.
  std::span<const std::uint8_t> inward;

  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
    const auto& [i, j, k] = body.placed.mesh->triangles[triangle];
    return {position[i], position[j], position[k]};
  }
};

/// The regions of contact (impinge/regions.hpp). `contacts` are all pairs of triangles that share a point or, with a
/// tolerance, all within it; sorted by a and then b. Nothing if stopped.
std::optional<std::vector<Region>> regions_of(const Side& a, const Side& b, std::span<const exact::Contact> contacts,
                                              double tolerance, const ForEach& for_each = {},
                                              const std::stop_token& stop = {});

/// How many pairs of triangles that are both small beside the tolerance (`is_small`) are found regions of: their number
/// grows with the square of the tolerance, and so must have an end, in proportion to the meshes.
std::size_t most_small_pairs(const solid::Body& a, const solid::Body& b);

/// The pairs within a tolerance above 0, as regions want them: the kinds are not told. Not all if stopped; nothing if
/// more than `most` are small.
std::optional<std::vector<exact::Contact>> contacts_within(const solid::Body& a, const solid::Body& b, double tolerance,
                                                           std::size_t most, const std::stop_token& stop = {});

}  // namespace impinge::clash
