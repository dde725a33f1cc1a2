// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "partition/sweep.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/compress-inl.hpp"
#include "core/mask_bits-inl.hpp"
#include "hierarchy/frame_relation-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::partition::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using hierarchy::WideLeaf;
using hierarchy::HWY_NAMESPACE::FrameRelation;
using impinge::HWY_NAMESPACE::compress_order;
using impinge::HWY_NAMESPACE::compressed;
using impinge::HWY_NAMESPACE::mask_bits;
using Lanes = hn::CappedTag<float, SweepState::kMostLanes>;

/// How far either leaf's triangles, in the frame of A's, may be from where the relation's map takes the world's:
///   A's are off by what their leaf says, and by the double error, in which the rounding of world vertices is;
///   B's by what their leaf says, under the rotation C; by F_B⁻¹ - F_Bᵀ, which the leaf knows; by the rounding of C
///   (half of u = 2^-24 an entry) and of c, and by three products and sums, fused or not: together less than
///   u (4 |c| + 12 r_b). Another u (|c| + 2 r_b) is for the sum that makes a box larger.
HWY_INLINE float error_of(const WideLeaf& a, const WideLeaf& b, const FrameRelation& f,
                          const hierarchy::TreeRelation& relation) {
  const auto scale = static_cast<float>(relation.scale), rounding = static_cast<float>(relation.error);
  const float far = std::max({std::abs(f.c[0]), std::abs(f.c[1]), std::abs(f.c[2])});
  const float error_a = a.error + rounding;
  const float error_b =
      scale * (1.8f * b.error + b.inverse_error) + 0x1p-24f * (5 * far + 14 * scale * b.frame.radius) + 2 * rounding;
  return 1.001f * std::max(error_a, error_b) + 0x1p-120f;
}

/// hn::Iota of Highway 1.0.3 writes its lanes one by one and waits until they can be read as one.
alignas(64) constexpr std::uint32_t kCount[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// Poses B's leaf from `first` on and appends its triangles that reach A's leaf to the rows; returns their number.
HWY_INLINE std::size_t pose_leaf(const hierarchy::WideLeafPair& pair, const FrameRelation& f, std::size_t first,
                                 std::size_t row, float error, SweepState& s) {
  const Lanes d;
  const hn::RebindToUnsigned<Lanes> du;
  const WideLeaf &a = *pair.a, &b = *pair.b;
  const auto margin = hn::Set(d, 2 * error);  // a shared point is within the error of both triangles
  const auto scale = static_cast<float>(s.relation->scale);
  const std::size_t stride = b.stride;
  const float* const coordinates = b.row(0);
  std::size_t rows = 0;
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    auto reaches = hn::FirstN(d, b.count - std::min<std::size_t>(b.count, lane));
    for (std::size_t r = 0; r < 3; ++r) {
      const auto Cx = hn::Set(d, scale * f.columns[0][r]), Cy = hn::Set(d, scale * f.columns[1][r]),
                 Cz = hn::Set(d, scale * f.columns[2][r]), c = hn::Set(d, f.c[r]);
      const auto posed = [&](std::size_t vertex) HWY_ATTR {
        const float* const x = coordinates + 3 * vertex * stride + lane;
        const auto result =
            hn::MulAdd(Cx, hn::LoadU(d, x),
                       hn::MulAdd(Cy, hn::LoadU(d, x + stride), hn::MulAdd(Cz, hn::LoadU(d, x + 2 * stride), c)));
        hn::StoreU(result, d, s.posed[3 * vertex + r] + first + lane);
        return result;
      };
      const auto p = posed(0), q = posed(1), t = posed(2);
      const auto least = hn::Sub(hn::Min(p, hn::Min(q, t)), margin);
      const auto greatest = hn::Add(hn::Max(p, hn::Max(q, t)), margin);
      hn::StoreU(least, d, s.box_b[2 * r] + first + lane);
      hn::StoreU(greatest, d, s.box_b[2 * r + 1] + first + lane);
      const auto half = hn::Set(d, a.half[r]);
      reaches = hn::And(reaches, hn::And(hn::Le(least, half), hn::Ge(greatest, hn::Neg(half))));
    }
    const std::uint32_t bits = mask_bits(d, reaches);
    const auto counted = hn::Add(hn::LoadU(du, kCount), hn::Set(du, static_cast<std::uint32_t>(first + lane)));
    const auto places = hn::BitCast(d, counted);
    hn::StoreU(hn::BitCast(du, compressed(places, compress_order(bits))), du, s.rows + row + rows);
    rows += static_cast<std::size_t>(std::popcount(bits));
  }
  return rows;
}

HWY_INLINE void prefetch(const WideLeaf& leaf) {
  const char* const begin = reinterpret_cast<const char*>(&leaf);
  for (std::size_t byte = 0; byte < sizeof(WideLeaf) + std::size_t{9} * 64; byte += 64) hwy::Prefetch(begin + byte);
}

/// Takes up as many leaf pairs as fit.
void prepare_group(SweepState& s) {
  constexpr std::size_t kAhead = 4;
  FrameRelation relations[SweepState::kGroup];
  std::size_t lane = 0, row = 0;
  s.group_size = s.next_pair = 0;
  while (s.group_size < std::min(SweepState::kGroup, s.pairs.size())) {
    const hierarchy::WideLeafPair& pair = s.pairs[s.group_size];
    if (lane + pair.b->stride > SweepState::kLanes) break;
    if (s.group_size + kAhead < s.pairs.size()) {
      prefetch(*s.pairs[s.group_size + kAhead].a);
      prefetch(*s.pairs[s.group_size + kAhead].b);
    }
    relations[s.group_size] = hierarchy::HWY_NAMESPACE::relate_frames(pair.a->frame, pair.b->frame, *s.relation);
    auto& member = s.group[s.group_size];
    member.error = error_of(*pair.a, *pair.b, relations[s.group_size], *s.relation);
    member.first_lane = static_cast<std::uint32_t>(lane);
    lane += pair.b->stride, ++s.group_size;
  }
  for (std::size_t i = 0; i < s.group_size; ++i) {
    auto& member = s.group[i];
    member.first_row = static_cast<std::uint32_t>(row);
    row += pose_leaf(s.pairs[i], relations[i], member.first_lane, row, member.error, s);
    member.end_row = static_cast<std::uint32_t>(row);
  }
}

/// The boxes of A's leaf.
HWY_INLINE void bound_leaf(const WideLeaf& a, SweepState& s) {
  const Lanes d;
  const std::size_t stride = a.stride;
  const float* const coordinates = a.row(0);
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    for (std::size_t r = 0; r < 3; ++r) {
      const float* const x = coordinates + r * stride + lane;
      const auto p = hn::LoadU(d, x), q = hn::LoadU(d, x + 3 * stride), t = hn::LoadU(d, x + 6 * stride);
      hn::Store(hn::Min(p, hn::Min(q, t)), d, s.box_a[2 * r] + lane);
      hn::Store(hn::Max(p, hn::Max(q, t)), d, s.box_a[2 * r + 1] + lane);
    }
  }
}

/// The corners of A's triangles that are embedded stars' vertices; in the places of others, what B's never have.
HWY_INLINE void name_corners(const WideLeaf& a, SweepState& s) {
  const hn::RebindToUnsigned<Lanes> du;
  const hn::RebindToSigned<Lanes> di;
  const auto* const corners = reinterpret_cast<const std::int32_t*>(s.stars->corners.data());
  const auto most = hn::Set(du, EmbeddedStars::kNone - 1);
  for (std::size_t lane = 0; lane < a.stride; lane += hn::Lanes(du)) {
    const auto id = hn::BitCast(di, hn::Load(du, a.ids() + lane)), place = hn::Add(id, hn::Add(id, id));
    for (std::size_t k = 0; k < 3; ++k)
      hn::Store(hn::Min(hn::BitCast(du, hn::GatherIndex(di, corners + k, place)), most), du, s.corners_a[k] + lane);
  }
}

/// A bit for each of A's triangles, one a lane from `first` on, that has one of the corners in common.
HWY_INLINE std::uint32_t with_common_corner(const std::array<std::uint32_t, 3>& corners, std::size_t first,
                                            const SweepState& s) {
  const hn::RebindToUnsigned<Lanes> du;
  const auto a0 = hn::Load(du, s.corners_a[0] + first), a1 = hn::Load(du, s.corners_a[1] + first),
             a2 = hn::Load(du, s.corners_a[2] + first);
  const auto has = [&](std::uint32_t corner) HWY_ATTR {
    const auto b = hn::Set(du, corner);
    return hn::Or(hn::Eq(a0, b), hn::Or(hn::Eq(a1, b), hn::Eq(a2, b)));
  };
  return mask_bits(Lanes(), hn::RebindMask(Lanes(), hn::Or(has(corners[0]), hn::Or(has(corners[1]), has(corners[2])))));
}

/// Turns to the next leaf pair of the group.
void open_pair(SweepState& s) {
  const auto& member = s.group[s.next_pair];
  const WideLeaf& a = *s.pairs[s.next_pair++].a;
  s.next_first = s.end_first = 0;
  if (member.first_row == member.end_row) return;
  bound_leaf(a, s);
  if (s.stars != nullptr) name_corners(a, s);
  s.end_first = a.count;
}

/// Lists what the next of A's triangles, one a lane, meet of B's.
template <bool kWithStars>
void find_hits(SweepState& s) {
  const Lanes d;
  const auto& member = s.group[s.next_pair - 1];
  const std::size_t first = std::exchange(s.next_first, s.next_first + hn::Lanes(d)), left = s.end_first - first;
  const std::uint32_t filled = (1u << std::min(left, hn::Lanes(d))) - 1;
  const auto load = [&](int r) HWY_ATTR { return hn::Load(d, s.box_a[r] + first); };
  const auto lo_x = load(0), hi_x = load(1), lo_y = load(2), hi_y = load(3), lo_z = load(4), hi_z = load(5);
  const bool one_order = s.one_order && s.pairs[s.next_pair - 1].a == s.pairs[s.next_pair - 1].b;
  std::size_t hits = 0;
  for (std::uint32_t i = member.first_row; i < member.end_row; ++i) {
    const std::uint32_t row = s.rows[i];
    const auto meet = [&](int r, hn::Vec<Lanes> lo, hn::Vec<Lanes> hi) HWY_ATTR {
      return hn::And(hn::Le(lo, hn::Set(d, s.box_b[r + 1][row])), hn::Ge(hi, hn::Set(d, s.box_b[r][row])));
    };
    std::uint32_t mask =
        filled & mask_bits(d, hn::And(meet(0, lo_x, hi_x), hn::And(meet(2, lo_y, hi_y), meet(4, lo_z, hi_z))));
    if (one_order) {
      const std::size_t place = row - member.first_lane, before = place - std::min(place, first);
      mask &= (1u << std::min<std::size_t>(before, SweepState::kMostLanes)) - 1;
    }
    if constexpr (kWithStars) {
      const std::uint32_t id = s.pairs[s.next_pair - 1].b->ids()[row - member.first_lane];
      if (mask != 0) mask &= ~with_common_corner(s.stars->corners[id], first, s);
    }
    s.hits[hits] = {row, mask};
    hits += mask != 0;
  }
  s.next_hit = 0, s.hit_count = hits;
}

/// Writes those of the hits that come next and lie among as many of B's triangles as there are lanes: their places are
/// listed, then each row of the stream is looked up in a row of either leaf.
HWY_INLINE void write_tile(SweepState& s, PairStream& out) {
  const Lanes d;
  const hn::RebindToUnsigned<Lanes> du;
  const std::size_t lanes = hn::Lanes(d), row_b = s.hits[s.next_hit].row / lanes * lanes;
  const auto count = hn::BitCast(d, hn::Load(du, kCount));
  std::size_t n = 0;
  do {
    const auto [row, mask] = s.hits[s.next_hit];
    hn::StoreU(hn::BitCast(du, compressed(count, compress_order(mask))), du, s.lanes_a + n);
    hn::StoreU(hn::Set(du, static_cast<std::uint32_t>(row - row_b)), du, s.lanes_b + n);
    n += static_cast<std::size_t>(std::popcount(mask));
  } while (++s.next_hit < s.hit_count && s.hits[s.next_hit].row - row_b < lanes);

  const auto& member = s.group[s.next_pair - 1];
  const WideLeaf &a = *s.pairs[s.next_pair - 1].a, &b = *s.pairs[s.next_pair - 1].b;
  const std::size_t first_a = s.next_first - lanes, stride = a.stride;
  const float* const coordinates = a.row(0) + first_a;
  for (std::size_t i = 0; i < n; i += lanes) {
    const auto order_a = hn::IndicesFromVec(d, hn::Load(du, s.lanes_a + i));
    const auto order_b = hn::IndicesFromVec(d, hn::Load(du, s.lanes_b + i));
    const std::size_t to = out.size + i;
    for (std::size_t k = 0; k < 9; ++k) {
      hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, coordinates + k * stride), order_a), d, out.a[k] + to);
      hn::StoreU(hn::TableLookupLanes(hn::Load(d, s.posed[k] + row_b), order_b), d, out.b[k] + to);
    }
    const auto ids_a = hn::BitCast(d, hn::LoadU(du, a.ids() + first_a));
    const auto ids_b = hn::BitCast(d, hn::LoadU(du, b.ids() + row_b - member.first_lane));
    hn::StoreU(hn::BitCast(du, hn::TableLookupLanes(ids_a, order_a)), du, out.id_a + to);
    hn::StoreU(hn::BitCast(du, hn::TableLookupLanes(ids_b, order_b)), du, out.id_b + to);
    hn::StoreU(hn::Set(d, member.error), d, out.error + to);
  }
  out.size += n;
}

bool fill(SweepState& s, PairStream& out) {
  const std::size_t enough = PairStream::kCapacity - hn::Lanes(Lanes()) * hn::Lanes(Lanes());
  while (true) {
    while (s.next_hit < s.hit_count) {
      if (out.size > enough) return false;
      write_tile(s, out);
    }
    if (s.next_first < s.end_first) {
      s.stars == nullptr ? find_hits<false>(s) : find_hits<true>(s);
    } else if (s.next_pair < s.group_size) {
      open_pair(s);
    } else {
      s.pairs = s.pairs.subspan(s.group_size);
      s.group_size = s.next_pair = 0;
      if (s.pairs.empty()) return true;
      prepare_group(s);
    }
  }
}

}  // namespace impinge::partition::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::partition {

HWY_EXPORT(fill);

bool Sweep::fill(PairStream& stream) { return HWY_DYNAMIC_DISPATCH(fill)(state_, stream); }

}  // namespace impinge::partition
#endif
