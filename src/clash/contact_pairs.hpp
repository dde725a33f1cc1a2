// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "exact/contact.hpp"
#include "impinge/contacts.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// Corners of one body's triangles at which near pairs were left out of the list.
class LeftOut {
 public:
  /// Notes a vertex contact at a triangle's corner; returns whether it is the first one there.
  bool meet(std::uint32_t triangle, std::uint8_t corner, std::size_t triangles);
  /// Notes that a pair with a vertex contact at the corner is left out.
  void leave_out(std::uint32_t triangle, std::uint8_t corner) {
    bits_[triangle] |= static_cast<std::uint8_t>(8 << corner);
  }
  [[nodiscard]] bool at(std::uint32_t triangle, std::size_t corner) const {
    return !bits_.empty() && (bits_[triangle] >> (3 + corner) & 1) != 0;
  }

 private:
  std::vector<std::uint8_t> bits_;  ///< per triangle: 1 << corner where one was met, 8 << corner where one was left out
};

/// The pairs of triangles of two bodies that are near each other or share a point. Around a common vertex each triangle
/// of one body meets each triangle of the other: a great many pairs, most of which are vertex contacts. They are all
/// counted, but only one at each corner is kept, since it locates the boundaries as well as all of them do.
///
/// The number of near pairs of small triangles grows with the square of the tolerance. Such pairs are not kept either,
/// as only the triangles in them matter.
struct ContactPairs {
  std::vector<TrianglePair> near;             ///< pairs within the distance, sorted, without those left out
  std::vector<std::uint32_t> near_a, near_b;  ///< triangles in some near pair, kept or left out; sorted
  LeftOut of_a, of_b;                         ///< where vertex contacts were left out: all but one at each corner
  std::vector<exact::Contact>
      contacts;  ///< pairs that share a point, sorted; of those with one common corner alone, just the kept ones
  std::array<std::uint64_t, 3> counts{};  ///< numbers of all pairs that share a point, by Kind
  bool is_whole = true;                   ///< no pair was left out of `near`
  bool leaves_out_small = false;          ///< pairs of small triangles were left out

  [[nodiscard]] bool is_near() const { return !near_a.empty(); }
};

/// Whether a triangle is small beside the tolerance: no edge is longer than four tolerances.
bool is_small(const Triangle& triangle, double tolerance);

struct ContactPairsGoal {
  double within = 0;
  bool all_contacts = false;  ///< keep every pair that shares a point
  std::stop_token stop{};     ///< once it is requested, the result is meaningless
};

ContactPairs find_contact_pairs(const solid::Body& a, const solid::Body& b, const ContactPairsGoal& goal);

}  // namespace impinge::clash
