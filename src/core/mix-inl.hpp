// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_MIX_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_MIX_INL
#undef IMPINGE_MIX_INL
#else
#define IMPINGE_MIX_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <numeric>

HWY_BEFORE_NAMESPACE();
namespace impinge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using HashLanes = hn::CappedTag<std::uint64_t, 8>;
using HashVector = hn::Vec<HashLanes>;

/// `impinge::mix` of core/hash.hpp, for every lane.
HWY_INLINE HashVector mix(HashVector x) {
  const HashLanes d;
  x = hn::Add(x, hn::Set(d, 0x9E3779B97F4A7C15u));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<30>(x)), hn::Set(d, 0xBF58476D1CE4E5B9u));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<27>(x)), hn::Set(d, 0x94D049BB133111EBu));
  return hn::Xor(x, hn::ShiftRight<31>(x));
}
HWY_INLINE HashVector mix(HashVector hash, HashVector word) { return mix(hn::Xor(hash, mix(word))); }

/// Not hn::SumOfLanes: for AVX-512 g++ 12 adds as signed numbers, which may overflow.
HWY_INLINE std::uint64_t sum_of_lanes(HashVector sum) {
  const HashLanes d;
  alignas(64) std::uint64_t lanes[8];
  hn::Store(sum, d, lanes);
  return std::accumulate(lanes, lanes + hn::Lanes(d), std::uint64_t{0});
}

}  // namespace impinge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_MIX_INL
