// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "partition/sweep.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/compress-inl.hpp"
#include "core/mask_bits-inl.hpp"
#include "hierarchy/frame_relation-inl.hpp"
#include "partition/leaf_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::partition::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using hierarchy::WideLeaf;
using hierarchy::HWY_NAMESPACE::FrameRelation;
using impinge::HWY_NAMESPACE::compress_order;
using impinge::HWY_NAMESPACE::compressed;
using impinge::HWY_NAMESPACE::mask_bits;
using Lanes = hn::CappedTag<float, SweepState::kBlock>;

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
    for (int r = 0; r < 3; ++r) {
      const auto Cx = hn::Set(d, scale * f.columns[0][r]), Cy = hn::Set(d, scale * f.columns[1][r]),
                 Cz = hn::Set(d, scale * f.columns[2][r]), c = hn::Set(d, f.c[r]);
      const auto posed = [&](std::size_t vertex) HWY_ATTR {
        const float* const x = coordinates + 3 * vertex * stride + lane;
        const auto result =
            hn::MulAdd(Cx, hn::LoadU(d, x),
                       hn::MulAdd(Cy, hn::LoadU(d, x + stride), hn::MulAdd(Cz, hn::LoadU(d, x + 2 * stride), c)));
        hn::StoreU(result, d, s.posed[3 * vertex + static_cast<std::size_t>(r)] + first + lane);
        return result;
      };
      const auto p = posed(0), q = posed(1), t = posed(2);
      const auto least = hn::Sub(hn::Min(p, hn::Min(q, t)), margin);
      const auto greatest = hn::Add(hn::Max(p, hn::Max(q, t)), margin);
      hn::StoreU(least, d, s.box_b[2 * r] + first + lane);
      hn::StoreU(greatest, d, s.box_b[2 * r + 1] + first + lane);
      const auto half = hn::Set(d, s.keep_all ? WideLeaf::kNoTriangle : a.half[r]);
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
  for (std::size_t byte = 0; byte < sizeof(WideLeaf) + 9 * 64; byte += 64) hwy::Prefetch(begin + byte);
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
    if (s.group_size + kAhead < s.pairs.size()) prefetch(*s.pairs[s.group_size + kAhead].b);
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

/// A bit for each of a block of A's triangles whose boxes meet that of B's triangle.
HWY_INLINE std::uint32_t meeting(const SweepState& s, std::size_t block, std::size_t row) {
  const Lanes d;
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < SweepState::kBlock; lane += hn::Lanes(d)) {
    const std::size_t first = block * SweepState::kBlock + lane;
    const auto on_axis = [&](std::size_t r) HWY_ATTR {
      return hn::And(hn::Le(hn::Load(d, s.box_a[2 * r] + first), hn::Set(d, s.box_b[2 * r + 1][row])),
                     hn::Ge(hn::Load(d, s.box_a[2 * r + 1] + first), hn::Set(d, s.box_b[2 * r][row])));
    };
    bits |= mask_bits(d, hn::And(on_axis(0), hn::And(on_axis(1), on_axis(2)))) << lane;
  }
  return bits;
}

/// The same by the grid's cells.
std::uint32_t sharing_a_cell(const SweepState& s, std::size_t block, std::size_t row) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < SweepState::kBlock; ++i)
    bits |= std::uint32_t{(s.cells_a[block * SweepState::kBlock + i] & s.cells_b[row]) != 0} << i;
  return bits;
}

/// Lists what of A's leaf each row of the next pair meets.
void find_hits(SweepState& s) {
  const auto& member = s.group[s.next_pair];
  const WideLeaf& a = *s.pairs[s.next_pair].a;
  ++s.next_pair;
  s.hit_count = s.next_hit = 0;
  if (member.first_row == member.end_row) return;
  bound_leaf(a, s);
  if (s.by_grid) map_to_cells(s);
  const std::size_t blocks = (a.count + SweepState::kBlock - 1) / SweepState::kBlock;
  std::size_t hits = 0;
  for (std::uint32_t i = member.first_row; i < member.end_row; ++i) {
    const std::uint32_t row = s.rows[i];
    for (std::size_t block = 0; block < blocks; ++block) {
      std::uint32_t mask = 0xFFFF;
      if (!s.keep_all) mask = meeting(s, block, row);
      if (s.by_grid) mask &= sharing_a_cell(s, block, row);
      if (block + 1 == blocks) mask &= 0xFFFFu >> (blocks * SweepState::kBlock - a.count);
      s.hits[hits] = {static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(block), mask};
      hits += mask != 0;
    }
  }
  s.hit_count = hits;
}

/// Writes the pairs of one hit to the stream.
HWY_INLINE void write_hit(const SweepState& s, std::size_t hit, PairStream& out) {
  const Lanes d;
  const hn::RebindToUnsigned<Lanes> du;
  const std::uint32_t all_lanes = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(d)) - 1);
  const auto [row, block, mask] = s.hits[hit];
  const hierarchy::WideLeafPair& pair = s.pairs[s.next_pair - 1];
  const auto& member = s.group[s.next_pair - 1];
  const std::size_t stride = pair.a->stride;
  for (std::size_t lane = 0; lane < SweepState::kBlock; lane += hn::Lanes(d)) {
    const std::uint32_t bits = mask >> lane & all_lanes;
    const auto order = compress_order(bits);
    const std::size_t n = out.size, from = block * SweepState::kBlock + lane;
    const float* const coordinates = pair.a->row(0) + from;
    for (std::size_t k = 0; k < 9; ++k) {
      hn::StoreU(compressed(hn::LoadU(d, coordinates + k * stride), order), d, out.a[k] + n);
      hn::StoreU(hn::Set(d, s.posed[k][row]), d, out.b[k] + n);
    }
    hn::StoreU(hn::Set(d, member.error), d, out.error + n);
    const auto ids = hn::BitCast(d, hn::LoadU(du, pair.a->ids() + from));
    hn::StoreU(hn::BitCast(du, compressed(ids, order)), du, out.id_a + n);
    hn::StoreU(hn::Set(du, pair.b->ids()[row - member.first_lane]), du, out.id_b + n);
    out.size = n + static_cast<std::size_t>(std::popcount(bits));
  }
}

bool fill(SweepState& s, PairStream& out) {
  constexpr std::size_t kEnough = PairStream::kCapacity - SweepState::kBlock;
  while (true) {
    for (; s.next_hit < s.hit_count; ++s.next_hit) {
      if (out.size > kEnough) return false;
      write_hit(s, s.next_hit, out);
    }
    if (s.next_pair == s.group_size) {
      s.pairs = s.pairs.subspan(s.group_size);
      s.group_size = s.next_pair = 0;
      if (s.pairs.empty()) return true;
      prepare_group(s);
    }
    find_hits(s);
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
