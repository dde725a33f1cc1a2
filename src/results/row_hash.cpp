// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/row_hash.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "results/row_hash.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mix-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::results::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<std::uint64_t, 8>;
using V = hn::Vec<Lanes>;

using impinge::HWY_NAMESPACE::mix;

HWY_INLINE V contact_hashes(V contacts, V key_a, V key_b) {
  const Lanes d;
  const V a = hn::ShiftRight<33>(contacts);
  const V b = hn::And(hn::ShiftRight<2>(contacts), hn::Set(d, 0x7FFFFFFFu));
  const V kind = hn::And(contacts, hn::Set(d, 3));
  const V mixed_a = mix(key_a, a), mixed_b = mix(key_b, b);
  const auto in_order = hn::Lt(mixed_a, mixed_b);
  const V lower = hn::IfThenElse(in_order, mixed_a, mixed_b), upper = hn::IfThenElse(in_order, mixed_b, mixed_a);
  return mix(mix(lower, upper), kind);
}

std::uint64_t row_hash(std::span<const ContactKey> row, std::uint64_t key_a, std::uint64_t key_b) {
  const Lanes d;
  const V keys_a = hn::Set(d, key_a), keys_b = hn::Set(d, key_b);
  V sum = hn::Zero(d);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= row.size(); i += hn::Lanes(d))
    sum = hn::Add(sum, contact_hashes(hn::LoadU(d, row.data() + i), keys_a, keys_b));
  if (i < row.size()) {
    alignas(64) ContactKey rest[8] = {};
    std::copy(row.begin() + static_cast<std::ptrdiff_t>(i), row.end(), rest);
    const V hashes = contact_hashes(hn::Load(d, rest), keys_a, keys_b);
    sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(d, row.size() - i), hashes));
  }
  return impinge::HWY_NAMESPACE::sum_of_lanes(sum);
}

}  // namespace impinge::results::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::results {

HWY_EXPORT(row_hash);

std::uint64_t row_hash(std::span<const ContactKey> row, std::uint64_t key_a, std::uint64_t key_b) {
  return HWY_DYNAMIC_DISPATCH(row_hash)(row, key_a, key_b);
}

}  // namespace impinge::results
#endif
