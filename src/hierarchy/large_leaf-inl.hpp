// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_LARGE_LEAF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_LARGE_LEAF_INL
#undef IMPINGE_LARGE_LEAF_INL
#else
#define IMPINGE_LARGE_LEAF_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/mask_bits-inl.hpp"
#include "hierarchy/tree_relation.hpp"
#include "hierarchy/wide_boxes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A leaf's triangles, held against boxes of the other tree that are much smaller: by the triangles' planes, and by
/// their boxes along the axes of the leaf. Made once for many nodes.
//
// A direction n of the leaf's frame and the interval of n p over a triangle's corners p part the triangle from a box
// whatever n is, so that n may be rounded; it is at most 1 + 2^-20 long, and may be shorter. Let z be a shared point in
// the node's frame, |z| <= r_N in every coordinate, and p in the leaf's, |p| <= r_L, lengths in A's unit, s_L and s_N
// the units of the leaf's tree and of the node's (scale or 1), u = 2^-24. With H the linear map of the node's tree to
// the leaf's frame, and c where that takes the node's origin,
//   n p s_L = n c + (F_N Hᵀ n) z + e.
// e comes from rounding in double, here and in the relation, which is off by its error a coordinate; 4 times that is
// taken: less than 256 u_53 S. If the leaf is B's, H has Mᵀ for M⁻¹ : 6 defects s_L r_L. F_N⁻¹ - F_Nᵀ: 9 * 2^-20 s_N
// r_N. And from single precision: Hᵀ n and F_N times it are off by 20 u s_N a coordinate, 60 u s_N r_N; the sums, for
// |n c| is at most sqrt 3 (s_L r_L + s_N r_N) and a box's part along n no more, by 24 u (s_L r_L + s_N r_N). The
// interval of n p is off by the corners' errors, times 1.74, and 7 u s_L r_L. In all less than
//   4 error + (6 defect + 2^-19) s_L r_L + 2^-16 s_N r_N + 1.74 s_L leaf.error,
// and 2^-100 for underflow. Of what is apart, and perhaps far apart, sums are off by another 24 u times the distance.
class LargeLeaf {
 public:
  /// Some of the triangles, a bit each.
  using Triangles = std::uint64_t;
  static constexpr std::size_t kMost = 64;

  LargeLeaf() = default;
  HWY_INLINE void set(const WideLeaf& leaf, bool leaf_is_a, const TreeRelation& trees);
  /// Two bodies may share a tree: a leaf may come as either's.
  [[nodiscard]] bool is(const WideLeaf& leaf, bool leaf_is_a) const { return leaf_ == &leaf && is_a_ == leaf_is_a; }
  [[nodiscard]] Triangles all() const { return ~Triangles{0} >> (kMost - leaf_->count); }
  enum class Side : std::uint8_t { none, a, b };
  /// Which of the two is a leaf of not too many triangles and more than twice as large as the other.
  static HWY_INLINE Side side_of(const TreeRef& a, const TreeRef& b, const TreeRelation& trees) {
    const float size_a = frame_of(a).radius, size_b = static_cast<float>(trees.scale) * frame_of(b).radius;
    if (a.is_leaf() && 2 * size_b < size_a) return a.leaf().count <= kMost ? Side::a : Side::none;
    if (b.is_leaf() && 2 * size_a < size_b) return b.leaf().count <= kMost ? Side::b : Side::none;
    return Side::none;
  }

  /// What of some of the triangles and of a node's boxes may share a point.
  struct Meeting {
    unsigned boxes;       ///< a bit for each that may meet a triangle
    Triangles triangles;  ///< that may meet a box
    /// About the least distance of each such box's centre from the planes of those that it meets.
    float height[kWidth];
  };
  HWY_INLINE Meeting meet(const WideNode& node, Triangles among) const;
  /// Whether some of the triangles may share a point with one of another leaf's.
  HWY_INLINE bool meets(const WideLeaf& other, Triangles among) const;
  /// Squares of lower bounds of the distances between a node's boxes and all triangles, in the leaf's frame and in A's
  /// unit; 0 where they may share a point. They are right as far as `within`; 3e36 stands for farther ones.
  HWY_INLINE void square_gaps(const WideNode& node, float within, float squares[kWidth]) const;

 private:
  using Lanes = hn::CappedTag<float, 16>;

  /// A frame of the other tree, and where its origin lies in the leaf's.
  struct View {
    const Frame& frame;
    float c[3];
    float slack;
  };
  [[nodiscard]] HWY_INLINE View from(const Frame& frame) const;
  /// The triangles that may be so near to a cube about the view's frame that holds all that is in it.
  [[nodiscard]] HWY_INLINE Triangles near(const View& view, float within) const;
  /// n c - middle and F_N H^T n: a point z of the frame is at `offset` + z `m` along a triangle's normal.
  struct Plane {
    float m[3], offset, reach;
  };
  [[nodiscard]] HWY_INLINE Plane plane(const View& view, std::size_t t) const;
  /// A node's boxes along the leaf's axes.
  HWY_INLINE void map(const View& view, const WideNode& node, Boxes& in_leaf) const;

  using BoxLanes = hn::CappedTag<float, kWidth>;
  using OfBoxes = hn::Vec<BoxLanes>;
  /// How far boxes' centres are from a triangle's plane, and how near they must be to meet it.
  struct Along {
    OfBoxes distance, reach;
  };
  static HWY_INLINE Along along(const Plane& plane, const WideNode& node, std::size_t lane);

  const WideLeaf* leaf_ = nullptr;
  bool is_a_ = false;
  float node_scale_;
  float own_slack_;               ///< the slack's part that every node has
  alignas(32) double map_[3][4];  ///< H: column k is what it makes of axis k of the node's tree
  alignas(32) double shift_[4];   ///< where it takes the origin of that tree
  alignas(64) float normal_[3][kMost];
  alignas(64) float turned_[3][kMost];  ///< the normals by Hᵀ
  alignas(64) float middle_[kMost];     ///< of the interval along the normal
  alignas(64) float reach_[kMost];      ///< half its length
  alignas(64) float lo_[3][kMost];
  alignas(64) float hi_[3][kMost];
};

HWY_INLINE void LargeLeaf::set(const WideLeaf& leaf, bool leaf_is_a, const TreeRelation& trees) {
  leaf_ = &leaf, is_a_ = leaf_is_a;
  const hn::CappedTag<double, 4> d4;
  const hn::Rebind<float, decltype(d4)> f4;
  double move[3];  // from the node's tree, turned by M⁻¹ if the leaf is B's, to the leaf's origin
  if (leaf_is_a) {
    for (int l = 0; l < 3; ++l) move[l] = trees.t[l] - leaf.frame.origin[l];
  } else {
    for (int l = 0; l < 3; ++l) {
      move[l] = trees.t[l];
      for (int k = 0; k < 3; ++k) move[l] += trees.scaled_columns[k][l] * leaf.frame.origin[k];
      move[l] = -move[l];
    }
  }
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d4)) {
    const auto axes = [&](int l) HWY_ATTR { return hn::PromoteTo(d4, hn::LoadU(f4, leaf.frame.axes[l] + lane)); };
    const auto x = axes(0), y = axes(1), z = axes(2);
    const auto turned = [&](const double* v) HWY_ATTR {
      return hn::MulAdd(x, hn::Set(d4, v[0]), hn::MulAdd(y, hn::Set(d4, v[1]), hn::Mul(z, hn::Set(d4, v[2]))));
    };
    auto shift = hn::Zero(d4);
    for (int k = 0; k < 3; ++k) {
      const auto column = turned(leaf_is_a ? trees.scaled_columns[k] : trees.rows[k]);
      hn::Store(column, d4, map_[k] + lane);
      if (!leaf_is_a) shift = hn::MulAdd(column, hn::Set(d4, move[k]), shift);
    }
    hn::Store(leaf_is_a ? turned(move) : shift, d4, shift_ + lane);
  }

  const float leaf_scale = leaf_is_a ? 1 : static_cast<float>(trees.scale);
  node_scale_ = leaf_is_a ? static_cast<float>(trees.scale) : 1;
  own_slack_ = 4 * static_cast<float>(trees.error) + 0x1p-100f +
               (6 * static_cast<float>(trees.defect) + 0x1p-19f) * leaf_scale * leaf.frame.radius +
               1.74f * leaf_scale * leaf.error;
  const Lanes d;
  using V = hn::Vec<Lanes>;
  const V factor = hn::Set(d, leaf_scale);
  for (std::size_t lane = 0; lane < leaf.count; lane += hn::Lanes(d)) {
    V p[3], q[3], r[3], normal[3];
    V square = hn::Set(d, 0x1p-100f);
    for (int i = 0; i < 3; ++i) {
      const auto corner = [&](int k) HWY_ATTR { return hn::Mul(factor, hn::Load(d, leaf.row(3 * k + i) + lane)); };
      p[i] = corner(0), q[i] = corner(1), r[i] = corner(2);
      hn::Store(hn::Min(p[i], hn::Min(q[i], r[i])), d, lo_[i] + lane);
      hn::Store(hn::Max(p[i], hn::Max(q[i], r[i])), d, hi_[i] + lane);
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] =
          hn::Sub(hn::Mul(hn::Sub(q[j], p[j]), hn::Sub(r[k], p[k])), hn::Mul(hn::Sub(q[k], p[k]), hn::Sub(r[j], p[j])));
      square = hn::MulAdd(normal[i], normal[i], square);
    }
    // One of Newton's steps, which never makes a direction longer than it is to be.
    const V first = hn::ApproximateReciprocalSqrt(square), half_square = hn::Mul(hn::Set(d, 0.5f), square);
    const V per_length = hn::Mul(first, hn::NegMulAdd(half_square, hn::Mul(first, first), hn::Set(d, 1.5f)));
    for (int i = 0; i < 3; ++i) normal[i] = hn::Mul(normal[i], per_length), hn::Store(normal[i], d, normal_[i] + lane);
    const auto along = [&](const V* v) HWY_ATTR {
      return hn::MulAdd(normal[0], v[0], hn::MulAdd(normal[1], v[1], hn::Mul(normal[2], v[2])));
    };
    const V a = along(p), b = along(q), c = along(r), half = hn::Set(d, 0.5f);
    const V least = hn::Min(a, hn::Min(b, c)), greatest = hn::Max(a, hn::Max(b, c));
    hn::Store(hn::Mul(half, hn::Add(least, greatest)), d, middle_ + lane);
    hn::Store(hn::Mul(half, hn::Sub(greatest, least)), d, reach_ + lane);
    for (int k = 0; k < 3; ++k) {
      const auto part = [&](int i) HWY_ATTR { return hn::Set(d, static_cast<float>(map_[k][i])); };
      hn::Store(hn::MulAdd(part(0), normal[0], hn::MulAdd(part(1), normal[1], hn::Mul(part(2), normal[2]))), d,
                turned_[k] + lane);
    }
  }
}

HWY_INLINE LargeLeaf::View LargeLeaf::from(const Frame& frame) const {
  View view{frame, {}, own_slack_ + 0x1p-16f * node_scale_ * frame.radius};
  for (int i = 0; i < 3; ++i) {
    const double x =
        shift_[i] + map_[0][i] * frame.origin[0] + map_[1][i] * frame.origin[1] + map_[2][i] * frame.origin[2];
    // Frames so far apart never overlap; clamped, no product with it overflows.
    view.c[i] = static_cast<float>(std::clamp(x, -1e20, 1e20));
  }
  return view;
}

HWY_INLINE LargeLeaf::Plane LargeLeaf::plane(const View& view, std::size_t t) const {
  Plane plane;
  const auto& axes = view.frame.axes;
  for (int i = 0; i < 3; ++i)
    plane.m[i] = axes[0][i] * turned_[0][t] + axes[1][i] * turned_[1][t] + axes[2][i] * turned_[2][t];
  plane.offset = normal_[0][t] * view.c[0] + normal_[1][t] * view.c[1] + normal_[2][t] * view.c[2] - middle_[t];
  plane.reach = reach_[t] + view.slack;
  return plane;
}

HWY_INLINE void LargeLeaf::map(const View& view, const WideNode& node, Boxes& in_leaf) const {
  float D[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      D[i][k] = 0;
      for (int l = 0; l < 3; ++l) D[i][k] += static_cast<float>(map_[l][i]) * view.frame.axes[l][k];
    }
  constexpr float kNone[3] = {0, 0, 0};
  map_boxes(node.center, node.half, D, kNone, view.c, view.slack, in_leaf);
}

HWY_INLINE LargeLeaf::Along LargeLeaf::along(const Plane& plane, const WideNode& node, std::size_t lane) {
  const BoxLanes d;
  Along along{hn::Set(d, plane.offset), hn::Set(d, plane.reach)};
  for (int i = 0; i < 3; ++i) {
    const OfBoxes part = hn::Set(d, plane.m[i]);
    along.distance = hn::MulAdd(part, hn::Load(d, node.center[i] + lane), along.distance);
    along.reach = hn::MulAdd(hn::Abs(part), hn::Load(d, node.half[i] + lane), along.reach);
  }
  along.distance = hn::Abs(along.distance);
  return along;
}

HWY_INLINE LargeLeaf::Triangles LargeLeaf::near(const View& view, float within) const {
  const Lanes d;
  const float reach = view.slack + 1.74f * node_scale_ * view.frame.radius + within;
  Triangles triangles = 0;
  for (std::size_t lane = 0; lane < leaf_->count; lane += hn::Lanes(d)) {
    auto distance = hn::Neg(hn::Load(d, middle_ + lane));
    for (int i = 0; i < 3; ++i) distance = hn::MulAdd(hn::Load(d, normal_[i] + lane), hn::Set(d, view.c[i]), distance);
    auto is_near = hn::Le(hn::Abs(distance), hn::Add(hn::Set(d, reach), hn::Load(d, reach_ + lane)));
    for (int i = 0; i < 3; ++i)
      is_near = hn::And(is_near, hn::And(hn::Le(hn::Load(d, lo_[i] + lane), hn::Set(d, view.c[i] + reach)),
                                         hn::Ge(hn::Load(d, hi_[i] + lane), hn::Set(d, view.c[i] - reach))));
    is_near = hn::And(is_near, hn::FirstN(d, leaf_->count - lane));
    triangles |= Triangles{impinge::HWY_NAMESPACE::mask_bits(d, is_near)} << lane;
  }
  return triangles;
}

HWY_INLINE LargeLeaf::Meeting LargeLeaf::meet(const WideNode& node, Triangles among) const {
  const BoxLanes d;
  const View view = from(node.frame);
  if (std::popcount(among) > 4) among &= near(view, 0);
  Meeting meeting;
  meeting.boxes = 0, meeting.triangles = 0;
  std::fill_n(meeting.height, kWidth, 1e30f);
  const unsigned filled = (1u << node.size) - 1;
  Boxes in_leaf;
  bool is_mapped = false;  // when the first box meets a plane
  for (; among != 0; among &= among - 1) {
    const auto t = static_cast<std::size_t>(std::countr_zero(among));
    const Plane plane = this->plane(view, t);
    unsigned bits = 0;
    alignas(64) float height[kWidth];
    for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
      const Along boxes = along(plane, node, lane);
      hn::Store(boxes.distance, d, height + lane);
      bits |= impinge::HWY_NAMESPACE::mask_bits(d, hn::Le(boxes.distance, boxes.reach)) << lane;
    }
    bits &= filled;
    if (bits == 0) continue;
    if (!std::exchange(is_mapped, true)) map(view, node, in_leaf);
    unsigned meets = 0;
    for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
      auto mask = hn::FirstN(d, kWidth);
      for (int i = 0; i < 3; ++i) {
        const OfBoxes middle = hn::Load(d, in_leaf.center[i] + lane), extent = hn::Load(d, in_leaf.half[i] + lane);
        mask = hn::And(mask, hn::And(hn::Le(hn::Sub(middle, extent), hn::Set(d, hi_[i][t])),
                                     hn::Ge(hn::Add(middle, extent), hn::Set(d, lo_[i][t]))));
      }
      meets |= impinge::HWY_NAMESPACE::mask_bits(d, mask) << lane;
    }
    bits &= meets;
    if (bits == 0) continue;
    meeting.boxes |= bits, meeting.triangles |= Triangles{1} << t;
    for (; bits != 0; bits &= bits - 1) {
      const int box = std::countr_zero(bits);
      meeting.height[box] = std::min(meeting.height[box], height[box]);
    }
  }
  return meeting;
}

HWY_INLINE void LargeLeaf::square_gaps(const WideNode& node, float within, float squares[kWidth]) const {
  const BoxLanes d;
  const OfBoxes zero = hn::Zero(d), far = hn::Set(d, 1e18f), sure = hn::Set(d, 1 - 0x1p-18f);
  const View view = from(node.frame);
  std::fill_n(squares, kWidth, 3e36f);
  Triangles triangles = near(view, std::min(1.001f * within, 1e25f));
  if (triangles == 0) return;
  Boxes in_leaf;
  map(view, node, in_leaf);
  for (; triangles != 0; triangles &= triangles - 1) {
    const auto t = static_cast<std::size_t>(std::countr_zero(triangles));
    const Plane plane = this->plane(view, t);
    for (std::size_t lane = 0; lane < kWidth; lane += hn::Lanes(d)) {
      const auto clamped = [&](OfBoxes gap) HWY_ATTR { return hn::Mul(sure, hn::Min(hn::Max(gap, zero), far)); };
      OfBoxes square = zero;
      for (int i = 0; i < 3; ++i) {
        const OfBoxes middle = hn::Load(d, in_leaf.center[i] + lane), extent = hn::Load(d, in_leaf.half[i] + lane);
        const OfBoxes gap = clamped(hn::Max(hn::Sub(hn::Set(d, lo_[i][t]), hn::Add(middle, extent)),
                                            hn::Sub(hn::Sub(middle, extent), hn::Set(d, hi_[i][t]))));
        square = hn::MulAdd(gap, gap, square);
      }
      const Along boxes = along(plane, node, lane);
      const OfBoxes gap = clamped(hn::Sub(boxes.distance, boxes.reach));
      square = hn::Max(square, hn::Mul(gap, gap));
      hn::StoreU(hn::Min(square, hn::LoadU(d, squares + lane)), d, squares + lane);
    }
  }
}

HWY_INLINE bool LargeLeaf::meets(const WideLeaf& other, Triangles among) const {
  const Lanes d;
  const View view = from(other.frame);
  const float stored = 1.74f * node_scale_ * other.error;
  for (; among != 0; among &= among - 1) {
    const Plane plane = this->plane(view, static_cast<std::size_t>(std::countr_zero(among)));
    const auto reach = hn::Set(d, plane.reach + stored);
    for (std::size_t lane = 0; lane < other.count; lane += hn::Lanes(d)) {
      const auto along = [&](int corner) HWY_ATTR {
        auto sum = hn::Set(d, plane.offset);
        for (int i = 0; i < 3; ++i)
          sum = hn::MulAdd(hn::Set(d, plane.m[i]), hn::Load(d, other.row(3 * corner + i) + lane), sum);
        return sum;
      };
      const auto p = along(0), q = along(1), r = along(2);
      const auto meet =
          hn::And(hn::Le(hn::Min(p, hn::Min(q, r)), reach), hn::Ge(hn::Max(p, hn::Max(q, r)), hn::Neg(reach)));
      if (!hn::AllFalse(d, hn::And(meet, hn::FirstN(d, other.count - lane)))) return true;
    }
  }
  return false;
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_LARGE_LEAF_INL
