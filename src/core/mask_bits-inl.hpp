// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_MASK_BITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_MASK_BITS_INL
#undef IMPINGE_MASK_BITS_INL
#else
#define IMPINGE_MASK_BITS_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace impinge::HWY_NAMESPACE {

/// Bit i is lane i; for masks of at most 16 lanes.
template <class D>
HWY_INLINE std::uint32_t mask_bits(D d, hwy::HWY_NAMESPACE::Mask<D> mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bytes);
  std::uint16_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

}  // namespace impinge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_MASK_BITS_INL
