// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/decide.hpp"

#include "exact/triangle_pair.hpp"

namespace impinge::paper {

std::uint64_t decide(const Batch& batch, std::span<const Verdict> pairs, std::vector<exact::Contact>& contacts) {
  std::uint64_t unsure = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i] == Verdict::no) continue;
    const CandidatePair& pair = batch.pairs[i];
    std::optional<Kind> kind = Kind::crossing;
    if (pairs[i] == Verdict::unsure) {
      ++unsure;
      kind = exact::classify(batch.triangle(pair.triangle_a), batch.triangle(pair.triangle_b));
    }
    if (kind) contacts.push_back({pair.id_a, pair.id_b, *kind});
  }
  return unsure;
}

}  // namespace impinge::paper
