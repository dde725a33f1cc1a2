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

/// A verdict with the contacts and the tolerance on which it rests.
struct Judgement {
  Verdict verdict = Verdict::apart;
  int inner = -1;
  Note note = Note::none;
  double tolerance = 0;                   ///< the tolerance that was applied
  bool touch = false;                     ///< whether the parts are no farther apart than the tolerance
  std::array<std::uint64_t, 3> counts{};  ///< numbers of pairs of triangles that share a point, by Kind
  std::vector<exact::Contact>
      contacts;  ///< these pairs, sorted: all of them with `all_contacts`, otherwise as in ContactPairs
};

struct JudgeGoal {
  std::optional<double> tolerance;  ///< if empty, 2^-20 of the pair's largest |world coordinate|
  bool all_contacts = false;
  std::stop_token stop{};  ///< once it is requested, the judgement is meaningless
};

Judgement judge_pair(const MeasuredPart& a, const MeasuredPart& b, const JudgeGoal& goal);

}  // namespace impinge::clash
