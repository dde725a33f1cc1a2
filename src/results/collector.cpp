// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/collector.hpp"

#include <algorithm>

namespace impinge::results {

bool precedes(const exact::Contact& p, const exact::Contact& q) {
  const auto triangles = [](const exact::Contact& c) { return std::uint64_t{c.a} << 32 | c.b; };
  return p.object_pair != q.object_pair ? p.object_pair < q.object_pair : triangles(p) < triangles(q);
}

void Collector::add(std::span<const exact::Contact> contacts) {
  constexpr std::size_t kSlack = 4096;
  for (const exact::Contact& contact : contacts) {
    if (!wants(contact.kind)) continue;
    ++seen_;
    kept_.push_back(contact);
  }
  if (limit_ < kept_.size() && kept_.size() - limit_ > limit_ + kSlack) {
    std::nth_element(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(limit_), kept_.end(), precedes);
    kept_.resize(limit_);
  }
}

}  // namespace impinge::results
