// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "clash/measured_part.hpp"
#include "exact/contact.hpp"
#include "impinge/clash.hpp"

namespace impinge::clash {

/// A verdict, and what was found on the way to it.
struct Judgement {
  Verdict verdict = Verdict::apart;
  int inner = -1;
  Note note = Note::none;
  double tolerance = 0;                   ///< that was applied
  bool touch = false;                     ///< they come as near as the tolerance
  std::array<std::uint64_t, 3> counts{};  ///< of pairs of triangles that share a point, by Kind
  std::vector<exact::Contact>
      contacts;  ///< these pairs, sorted: all of them if that was asked for, or as an ContactPairs's
};

struct JudgeGoal {
  std::optional<double> tolerance;  ///< nothing: 2^-20 of the pair's largest |world coordinate|
  bool all_contacts = false;
  std::stop_token stop{};  ///< then the judgement is worth nothing
};

Judgement judge_pair(const MeasuredPart& a, const MeasuredPart& b, const JudgeGoal& goal);

}  // namespace impinge::clash
