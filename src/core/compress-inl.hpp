// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_COMPRESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_COMPRESS_INL
#undef IMPINGE_COMPRESS_INL
#else
#define IMPINGE_COMPRESS_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "core/compress_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::HWY_NAMESPACE {

// Moving the lanes whose bits are set to the front of a vector of floats; what follows them is arbitrary. The look-up
// is made once for many vectors: hwy::Compress would repeat it, and with AVX2 and g++ 12 it copies its whole table to
// the stack each time.

using CompressLanes = hwy::HWY_NAMESPACE::CappedTag<float, 16>;

HWY_INLINE auto compress_order(std::uint32_t bits) {
  namespace hn = hwy::HWY_NAMESPACE;
  const CompressLanes d;
#if HWY_TARGET <= HWY_AVX3  // has an instruction for it
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(d, bytes);
#else
  const auto& row = kCompressTable[bits & ((1u << hn::Lanes(d)) - 1)];
  const hn::RebindToSigned<CompressLanes> di;
  return hn::IndicesFromVec(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint8_t, CompressLanes>(), row.data())));
#endif
}

template <class V, class Order>
HWY_INLINE V compressed(V v, Order order) {
#if HWY_TARGET <= HWY_AVX3
  return hwy::HWY_NAMESPACE::Compress(v, order);
#else
  return hwy::HWY_NAMESPACE::TableLookupLanes(v, order);
#endif
}

}  // namespace impinge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_COMPRESS_INL
