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

/// Corners of one body's triangles at which others were left out of the list.
class LeftOut {
 public:
  /// Whether a triangle's corner was met for the first time.
  bool meet(std::uint32_t triangle, std::uint8_t corner, std::size_t triangles);
  /// That a pair which meets in it is left out.
  void leave_out(std::uint32_t triangle, std::uint8_t corner) {
    bits_[triangle] |= static_cast<std::uint8_t>(8 << corner);
  }
  [[nodiscard]] bool at(std::uint32_t triangle, std::size_t corner) const {
    return !bits_.empty() && (bits_[triangle] >> (3 + corner) & 1) != 0;
  }

 private:
  std::vector<std::uint8_t> bits_;  ///< per triangle: 1 << corner where one was met, 8 << corner where one was left out
};

/// Where two bodies come together. About a vertex that both have, all triangles of one meet all of the other there: a
/// great many pairs, of which most part again at once (`VertexContact`). They are counted; but to know where the
/// boundaries lie to each other, one of them at each corner is as good as all.
///
/// The larger the tolerance, the more pairs of triangles that are small beside it: nobody asks which of them are near
/// which, so that they are not kept either.
struct ContactPairs {
  std::vector<TrianglePair> near;             ///< no farther apart than asked, sorted; but for what was left out
  std::vector<std::uint32_t> near_a, near_b;  ///< triangles in some near pair, kept or not, sorted
  LeftOut of_a, of_b;                     ///< near pairs that vertex_contact are left out, but for one at each corner
  std::vector<exact::Contact> contacts;   ///< that share a point, sorted; but for those that share one corner alone
  std::array<std::uint64_t, 3> counts{};  ///< of all contacts, by Kind
  bool is_whole = true;                   ///< nothing was left out of `near`
  bool leaves_out_small = false;          ///< pairs of small triangles were

  [[nodiscard]] bool is_near() const { return !near_a.empty(); }
};

/// Whether no edge is longer than four tolerances.
bool is_small(const Triangle& triangle, double tolerance);

struct ContactPairsGoal {
  double within = 0;
  bool all_contacts = false;  ///< leave none of them out
  std::stop_token stop{};     ///< then what was found is worth nothing
};

ContactPairs find_contact_pairs(const solid::Body& a, const solid::Body& b, const ContactPairsGoal& goal);

}  // namespace impinge::clash
