// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "paper/scalar.hpp"

namespace impinge::paper {
namespace {

/// By the filter of orient2d (exact/orientation.cpp) in each coordinate plane: the triangle's normal is not zero.
bool certainly_proper(const Triangle& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const auto differs = [](double left, double right) {
    return std::abs(left - right) > 0x1p-51 * (std::abs(left) + std::abs(right));
  };
  return differs(u.y * v.z, u.z * v.y) || differs(u.z * v.x, u.x * v.z) || differs(u.x * v.y, u.y * v.x);
}

}  // namespace

void fold(const Batch& batch, std::span<const Verdict> tests, std::vector<Verdict>& pairs) {
  pairs.assign(batch.pairs.size(), Verdict::no);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (tests[i] == Verdict::no) continue;
    for (const std::uint32_t pair : {batch.tests[i].first_pair, batch.tests[i].second_pair})
      if (pair != ElementTest::kNone) pairs[pair] = std::max(pairs[pair], tests[i]);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i] != Verdict::crossing) continue;
    const CandidatePair& pair = batch.pairs[i];
    if (!certainly_proper(batch.triangle(pair.triangle_a)) || !certainly_proper(batch.triangle(pair.triangle_b)))
      pairs[i] = Verdict::unsure;
  }
}

}  // namespace impinge::paper
