// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_FLOAT4_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_FLOAT4_INL
#undef IMPINGE_FLOAT4_INL
#else
#define IMPINGE_FLOAT4_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "core/mask_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Operators stand outside of their types: g++ 12 does not apply the instruction set to friends defined within, and
// without optimisation they would be called with their vectors in the wrong place.

/// Four floats, mostly x, y, z and something else.
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
struct Float4 {
  float lane[4];

  static HWY_INLINE Float4 load(const float* p) { return {{p[0], p[1], p[2], p[3]}}; }
  static HWY_INLINE Float4 load_aligned(const float* p) { return load(p); }
  static HWY_INLINE Float4 all(float x) { return {{x, x, x, x}}; }
  HWY_INLINE void store(float* p) const {
    for (int i = 0; i < 4; ++i) p[i] = lane[i];
  }
  HWY_INLINE void store_aligned(float* p) const { store(p); }
  HWY_INLINE void store_truncated(std::int32_t* p) const {
    for (int i = 0; i < 4; ++i) p[i] = static_cast<std::int32_t>(lane[i]);
  }
  template <int kLane>
  HWY_INLINE Float4 broadcast() const {
    return all(lane[kLane]);
  }
  /// Lanes 1, 2, 3, 0.
  HWY_INLINE Float4 rotated() const { return {{lane[1], lane[2], lane[3], lane[0]}}; }
  HWY_INLINE Float4 yzx() const { return {{lane[1], lane[2], lane[0], lane[3]}}; }
  /// Lanes by number.
  struct Pick {
    explicit HWY_INLINE Pick(const std::int32_t* lanes) : from{lanes[0], lanes[1], lanes[2], lanes[3]} {}
    std::int32_t from[4];
  };
  HWY_INLINE Float4 picked(const Pick& pick) const {
    return {{lane[pick.from[0]], lane[pick.from[1]], lane[pick.from[2]], lane[pick.from[3]]}};
  }
};
/// Bit i says whether lane i of a is at least that of b.
HWY_INLINE unsigned at_least(const Float4& a, const Float4& b) {
  unsigned bits = 0;
  for (int i = 0; i < 4; ++i) bits |= static_cast<unsigned>(a.lane[i] >= b.lane[i]) << i;
  return bits;
}
template <class Op>
HWY_INLINE Float4 each(const Float4& a, const Float4& b, const Op& op) {
  return {{op(a.lane[0], b.lane[0]), op(a.lane[1], b.lane[1]), op(a.lane[2], b.lane[2]), op(a.lane[3], b.lane[3])}};
}
HWY_INLINE Float4 operator+(const Float4& a, const Float4& b) {
  return each(a, b, [](float x, float y) { return x + y; });
}
HWY_INLINE Float4 operator-(const Float4& a, const Float4& b) {
  return each(a, b, [](float x, float y) { return x - y; });
}
HWY_INLINE Float4 operator*(const Float4& a, const Float4& b) {
  return each(a, b, [](float x, float y) { return x * y; });
}
HWY_INLINE Float4 min(const Float4& a, const Float4& b) {
  return each(a, b, [](float x, float y) { return x < y ? x : y; });
}
HWY_INLINE Float4 max(const Float4& a, const Float4& b) {
  return each(a, b, [](float x, float y) { return x > y ? x : y; });
}
#else
struct Float4 {
  using Tag = hn::FixedTag<float, 4>;
  hn::Vec<Tag> v;

  static HWY_INLINE Float4 load(const float* p) { return {hn::LoadU(Tag(), p)}; }
  static HWY_INLINE Float4 load_aligned(const float* p) { return {hn::Load(Tag(), p)}; }
  static HWY_INLINE Float4 all(float x) { return {hn::Set(Tag(), x)}; }
  HWY_INLINE void store(float* p) const { hn::StoreU(v, Tag(), p); }
  HWY_INLINE void store_aligned(float* p) const { hn::Store(v, Tag(), p); }
  HWY_INLINE void store_truncated(std::int32_t* p) const {
    const hn::RebindToSigned<Tag> tag;
    hn::StoreU(hn::ConvertTo(tag, v), tag, p);
  }
  template <int kLane>
  HWY_INLINE Float4 broadcast() const {
    return {hn::Broadcast<kLane>(v)};
  }
  HWY_INLINE Float4 rotated() const { return {hn::Shuffle0321(v)}; }
  HWY_INLINE Float4 yzx() const {
    alignas(16) constexpr std::int32_t kOrder[4] = {1, 2, 0, 3};
    return {hn::TableLookupLanes(v, hn::SetTableIndices(Tag(), kOrder))};
  }
  struct Pick {
    explicit HWY_INLINE Pick(const std::int32_t* lanes) : from(hn::SetTableIndices(Tag(), lanes)) {}
    decltype(hn::SetTableIndices(Tag(), static_cast<const std::int32_t*>(nullptr))) from;
  };
  HWY_INLINE Float4 picked(const Pick& pick) const { return {hn::TableLookupLanes(v, pick.from)}; }
};
HWY_INLINE unsigned at_least(const Float4& a, const Float4& b) {
  return impinge::HWY_NAMESPACE::mask_bits(Float4::Tag(), hn::Ge(a.v, b.v));
}
HWY_INLINE Float4 operator+(const Float4& a, const Float4& b) { return {hn::Add(a.v, b.v)}; }
HWY_INLINE Float4 operator-(const Float4& a, const Float4& b) { return {hn::Sub(a.v, b.v)}; }
HWY_INLINE Float4 operator*(const Float4& a, const Float4& b) { return {hn::Mul(a.v, b.v)}; }
HWY_INLINE Float4 min(const Float4& a, const Float4& b) { return {hn::Min(a.v, b.v)}; }
HWY_INLINE Float4 max(const Float4& a, const Float4& b) { return {hn::Max(a.v, b.v)}; }
#endif

/// Two of them side by side; in memory aligned to 32 bytes.
#if HWY_MAX_BYTES >= 32 && !HWY_HAVE_SCALABLE
struct Float8 {
  using Tag = hn::FixedTag<float, 8>;
  hn::Vec<Tag> v;

  static HWY_INLINE Float8 load_aligned(const float* p) { return {hn::Load(Tag(), p)}; }
  static HWY_INLINE Float8 all(float x) { return {hn::Set(Tag(), x)}; }
  static HWY_INLINE Float8 of(const Float4& front, const Float4& back) { return {hn::Combine(Tag(), back.v, front.v)}; }
  HWY_INLINE Float4 front() const { return {hn::LowerHalf(Float4::Tag(), v)}; }
  HWY_INLINE Float4 back() const { return {hn::UpperHalf(Float4::Tag(), v)}; }
  HWY_INLINE void store_aligned(float* p) const { hn::Store(v, Tag(), p); }
  template <int kLane>
  HWY_INLINE Float8 broadcast() const {
    return {hn::Broadcast<kLane>(v)};
  }
  HWY_INLINE Float8 rotated() const { return {hn::Shuffle0321(v)}; }
  HWY_INLINE Float8 yzx() const {
    alignas(32) constexpr std::int32_t kOrder[8] = {1, 2, 0, 3, 5, 6, 4, 7};
    return {hn::TableLookupLanes(v, hn::SetTableIndices(Tag(), kOrder))};
  }
};
HWY_INLINE Float8 operator+(const Float8& a, const Float8& b) { return {hn::Add(a.v, b.v)}; }
HWY_INLINE Float8 operator-(const Float8& a, const Float8& b) { return {hn::Sub(a.v, b.v)}; }
HWY_INLINE Float8 operator*(const Float8& a, const Float8& b) { return {hn::Mul(a.v, b.v)}; }
HWY_INLINE Float8 min(const Float8& a, const Float8& b) { return {hn::Min(a.v, b.v)}; }
HWY_INLINE Float8 max(const Float8& a, const Float8& b) { return {hn::Max(a.v, b.v)}; }
#else
struct Float8 {
  Float4 half[2];

  static HWY_INLINE Float8 load_aligned(const float* p) {
    return {{Float4::load_aligned(p), Float4::load_aligned(p + 4)}};
  }
  static HWY_INLINE Float8 all(float x) { return {{Float4::all(x), Float4::all(x)}}; }
  static HWY_INLINE Float8 of(const Float4& front, const Float4& back) { return {{front, back}}; }
  HWY_INLINE Float4 front() const { return half[0]; }
  HWY_INLINE Float4 back() const { return half[1]; }
  HWY_INLINE void store_aligned(float* p) const { half[0].store_aligned(p), half[1].store_aligned(p + 4); }
  template <int kLane>
  HWY_INLINE Float8 broadcast() const {
    return {{half[0].broadcast<kLane>(), half[1].broadcast<kLane>()}};
  }
  HWY_INLINE Float8 rotated() const { return {{half[0].rotated(), half[1].rotated()}}; }
  HWY_INLINE Float8 yzx() const { return {{half[0].yzx(), half[1].yzx()}}; }
};
HWY_INLINE Float8 operator+(const Float8& a, const Float8& b) {
  return {{a.half[0] + b.half[0], a.half[1] + b.half[1]}};
}
HWY_INLINE Float8 operator-(const Float8& a, const Float8& b) {
  return {{a.half[0] - b.half[0], a.half[1] - b.half[1]}};
}
HWY_INLINE Float8 operator*(const Float8& a, const Float8& b) {
  return {{a.half[0] * b.half[0], a.half[1] * b.half[1]}};
}
HWY_INLINE Float8 min(const Float8& a, const Float8& b) {
  return {{min(a.half[0], b.half[0]), min(a.half[1], b.half[1])}};
}
HWY_INLINE Float8 max(const Float8& a, const Float8& b) {
  return {{max(a.half[0], b.half[0]), max(a.half[1], b.half[1])}};
}
#endif

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_FLOAT4_INL
