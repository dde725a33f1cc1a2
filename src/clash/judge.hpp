// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "clash/known_part.hpp"
#include "exact/contact.hpp"
#include "impinge/clash.hpp"

namespace impinge::clash {

/// A verdict, and what was found on the way to it.
struct Judgement {
  Verdict verdict = Verdict::apart;
  int inner = -1;
  Note note = Note::none;
  double tolerance = 0;                  ///< that was applied
  bool touch = false;                    ///< they come as near as the tolerance
  std::vector<exact::Contact> contacts;  ///< every pair of triangles that share a point, sorted
};

/// `tolerance`: nothing is 2^-20 of the pair's largest |world coordinate|. Worth nothing if it was asked to stop.
Judgement judge_pair(const KnownPart& a, const KnownPart& b, std::optional<double> tolerance,
                     const std::stop_token& stop = {});

/// Every pair of triangles that share a point, sorted.
std::vector<exact::Contact> contacts_of(const solid::Body& a, const solid::Body& b);

}  // namespace impinge::clash
