// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/collector.hpp"

#include <algorithm>
#include <utility>

namespace impinge::results {

void Collector::restart(std::uint8_t kinds, std::uint64_t limit) {
  kinds_ = kinds, limit_ = limit, seen_ = 0;
  kept_.clear(), runs_.clear();
}

void Collector::add(std::uint32_t object_pair, std::span<const ContactKey> contacts) {
  constexpr std::size_t kSlack = 4096;
  const std::size_t before = kept_.size();
  if (kinds_ == kAllKinds) {
    kept_.insert(kept_.end(), contacts.begin(), contacts.end());
  } else {
    std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(kept_),
                 [&](ContactKey key) { return wants(kind_of(key)); });
  }
  const std::size_t added = kept_.size() - before;
  if (added == 0) return;
  seen_ += added;
  if (runs_.empty() || runs_.back().object_pair != object_pair) runs_.push_back({object_pair, 0});
  runs_.back().count += added;
  if (limit_ < kept_.size() && kept_.size() - limit_ > limit_ + kSlack) drop_beyond_limit();
}

void Collector::drop_beyond_limit() {
  if (runs_.size() == 1) {
    std::nth_element(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(limit_), kept_.end());
    kept_.resize(limit_), runs_.front().count = limit_;
    return;
  }
  std::vector<std::pair<std::uint32_t, ContactKey>> all;
  all.reserve(kept_.size());
  std::size_t next = 0;
  for (const Run& run : runs_)
    for (std::size_t i = 0; i < run.count; ++i) all.emplace_back(run.object_pair, kept_[next++]);
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(limit_), all.end());
  all.resize(limit_);
  std::sort(all.begin(), all.end());
  kept_.clear(), runs_.clear();
  for (const auto& [object_pair, key] : all) {
    kept_.push_back(key);
    if (runs_.empty() || runs_.back().object_pair != object_pair) runs_.push_back({object_pair, 0});
    ++runs_.back().count;
  }
}

}  // namespace impinge::results
