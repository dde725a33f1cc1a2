// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "narrow/pair_filter.hpp"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrow/pair_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/mask_bits-inl.hpp"
#include "narrow/triangle_pair-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::narrow::HWY_NAMESPACE {

using impinge::HWY_NAMESPACE::mask_bits;

template <bool kWithCommon>
HWY_INLINE void filter(const partition::PairStream& stream, Filtered& filtered) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const auto append = [&](std::uint64_t bits, std::size_t first, std::vector<TrianglePair>& ids) {
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
      ids.push_back({stream.id_a[i], stream.id_b[i]});
    }
  };
  for (std::size_t i = 0; i < stream.size; i += hn::Lanes(d)) {
    const auto load = [&](const float(&rows)[9][partition::PairStream::kStride], std::size_t vertex) HWY_ATTR {
      return Vec<V>{hn::Load(d, rows[3 * vertex] + i), hn::Load(d, rows[3 * vertex + 1] + i),
                    hn::Load(d, rows[3 * vertex + 2] + i)};
    };
    const Vec<V> a[3] = {load(stream.a, 0), load(stream.a, 1), load(stream.a, 2)};
    const Vec<V> b[3] = {load(stream.b, 0), load(stream.b, 1), load(stream.b, 2)};
    CommonMasks<hn::CappedTag<float, 16>> common;
    if constexpr (kWithCommon) {
      const hn::RebindToUnsigned<decltype(d)> du;
      const auto bits = hn::Load(du, stream.common + i);
      const auto is_set = [&](std::uint32_t bit)
                              HWY_ATTR { return hn::RebindMask(d, hn::TestBit(bits, hn::Set(du, bit))); };
      for (std::uint32_t corner = 0; corner < 3; ++corner)
        common.a[corner] = is_set(1u << corner), common.b[corner] = is_set(8u << corner);
    }
    const auto masks = test_pairs(d, a, b, hn::Load(d, stream.error + i), kWithCommon ? &common : nullptr);
    const auto here = hn::FirstN(d, stream.size - i);
    const auto crossing = hn::And(here, masks.crossing);
    const auto unsure = hn::AndNot(hn::Or(masks.no, masks.crossing), here);
    append(mask_bits(d, crossing), i, filtered.crossing);
    append(mask_bits(d, unsure), i, filtered.unsure);
  }
}

void filter_pairs(const partition::PairStream& stream, Filtered& filtered) { filter<false>(stream, filtered); }
void filter_self_pairs(const partition::PairStream& stream, Filtered& filtered) { filter<true>(stream, filtered); }

}  // namespace impinge::narrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::narrow {

HWY_EXPORT(filter_pairs);
HWY_EXPORT(filter_self_pairs);

void filter_pairs(const partition::PairStream& stream, Filtered& filtered) {
  HWY_DYNAMIC_DISPATCH(filter_pairs)(stream, filtered);
}
void filter_self_pairs(const partition::PairStream& stream, Filtered& filtered) {
  HWY_DYNAMIC_DISPATCH(filter_self_pairs)(stream, filtered);
}

}  // namespace impinge::narrow
#endif
