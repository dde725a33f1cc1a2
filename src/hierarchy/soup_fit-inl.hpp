// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

// Compiled once an instruction set: included after hwy/foreach_target.h, by that header's rules.
#if defined(IMPINGE_SOUP_FIT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IMPINGE_SOUP_FIT_INL
#undef IMPINGE_SOUP_FIT_INL
#else
#define IMPINGE_SOUP_FIT_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "hierarchy/float4-inl.hpp"
#include "hierarchy/principal_axes.hpp"
#include "hierarchy/soup_frame.hpp"
#include "hierarchy/soup_sample.hpp"
#include "hierarchy/triangle_soup.hpp"

// No fused operations here: the tree is the same on every instruction set.
HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

/// The corners of a triangle (Float4), or of two, one in each half (Float8).
template <class F>
struct Corners {
  F a, b, c;
};

HWY_INLINE Corners<Float4> corners(const SoupTriangle& triangle) {
  // The third corner is read from one place before it, not to take the id for a float.
  return {Float4::load(triangle.corner), Float4::load(triangle.corner + 3),
          Float4::load(triangle.corner + 5).rotated()};
}
HWY_INLINE Corners<Float8> corners(const SoupTriangle& one, const SoupTriangle& other) {
  return {Float8::of(Float4::load(one.corner), Float4::load(other.corner)),
          Float8::of(Float4::load(one.corner + 3), Float4::load(other.corner + 3)),
          Float8::of(Float4::load(one.corner + 5), Float4::load(other.corner + 5)).rotated()};
}

template <class F>
HWY_INLINE F spread(const Float4& v);
template <>
HWY_INLINE Float4 spread(const Float4& v) {
  return v;
}
template <>
HWY_INLINE Float8 spread(const Float4& v) {
  return Float8::of(v, v);
}

/// The map of a frame, ready for use. The fourth lane of its result is 0.
template <class F>
struct Rotation {
  F column[3], center;

  explicit HWY_INLINE Rotation(const SoupFrame& frame) : center(spread<F>(Float4::load(frame.center))) {
    for (int l = 0; l < 3; ++l) column[l] = spread<F>(Float4::load(frame.axes[l]) * Float4::all(frame.scale));
  }
  HWY_INLINE F operator()(const F& corner) const {
    const F d = corner - center;
    return column[0] * d.template broadcast<0>() + column[1] * d.template broadcast<1>() +
           column[2] * d.template broadcast<2>();
  }
};

template <class F>
struct CornerBox {
  F lo, hi;
};
template <class F>
HWY_INLINE CornerBox<F> box_of(const Corners<F>& v, const Rotation<F>& rotation) {
  const F a = rotation(v.a), b = rotation(v.b), c = rotation(v.c);
  return {min(min(a, b), c), max(max(a, b), c)};
}

/// The box of some triangles.
HWY_INLINE CornerBox<Float4> box_of_all(const SoupTriangle* triangles, std::size_t count, const SoupFrame& frame) {
  const Rotation<Float8> rotation(frame);
  CornerBox<Float8> all = box_of(corners(triangles[0], triangles[count - 1]), rotation);
  for (std::size_t i = 1; i + 1 < count; i += 2) {
    const CornerBox<Float8> box = box_of(corners(triangles[i], triangles[i + 1]), rotation);
    all = {min(all.lo, box.lo), max(all.hi, box.hi)};
  }
  return {min(all.lo.front(), all.lo.back()), max(all.hi.front(), all.hi.back())};
}

/// About how far the triangles reach from a point, by a few of them.
HWY_INLINE float reach_from(const Float4& point, const SoupTriangle* triangles, const SoupSample& sample) {
  Float4 lo = point, hi = point;
  constexpr std::uint32_t kLooks = 4;
  for (std::uint32_t i = 0; i < kLooks; ++i) {
    const Corners<Float4> v = corners(triangles[sample[i * (sample.size() - 1) / (kLooks - 1)]]);
    lo = min(lo, min(min(v.a, v.b), v.c)), hi = max(hi, max(max(v.a, v.b), v.c));
  }
  float reach[4];
  max(hi - point, point - lo).store(reach);
  return std::max({reach[0], reach[1], reach[2]});
}

/// The mean of the sampled triangles' corners and the principal axes of their covariance (the paper's equations 2 and
/// 3), in a unit of about the sample's extent. Both are summed at once, about a corner amid the sample.
HWY_INLINE SoupFrame fit_frame(const SoupTriangle* triangles, const SoupSample& sample) {
  const Float4 amid = corners(triangles[sample[sample.size() / 2]]).a;
  SoupFrame frame;
  frame.scale = SoupFrame::scale_for(reach_from(amid, triangles, sample));
  const Float8 origin = Float8::of(amid, amid), scale = Float8::all(frame.scale);
  Float8 sums = Float8::all(0), square_sums = sums, product_sums = sums;
  const auto add = [&](const Corners<Float8>& v) HWY_ATTR {
    for (const Float8& corner : {v.a, v.b, v.c}) {
      const Float8 d = (corner - origin) * scale;
      sums = sums + d;
      square_sums = square_sums + d * d;
      product_sums = product_sums + d * d.yzx();
    }
  };
  const std::uint32_t size = sample.size();
  for (std::uint32_t i = 0; i + 1 < size; i += 2) add(corners(triangles[sample[i]], triangles[sample[i + 1]]));
  if (size % 2 != 0) {
    // The last one alone: the other half stays at the origin, which adds nothing.
    const Corners<Float4> last = corners(triangles[sample[size - 1]]);
    add({Float8::of(last.a, amid), Float8::of(last.b, amid), Float8::of(last.c, amid)});
  }
  const auto total = [](const Float8& v) HWY_ATTR { return v.front() + v.back(); };
  const Float4 sum = total(sums), squares = total(square_sums), products = total(product_sums);
  const Float4 mean = sum * Float4::all(1 / (3 * static_cast<float>(size)));
  float s[4], p[4];
  (squares - sum * mean).store(s);
  (products - sum * mean.yzx()).store(p);
  principal_axes({s[0], s[1], s[2], p[0], p[1], p[2]}, frame.axes);
  (amid + mean * Float4::all(1 / frame.scale)).store(frame.center);
  frame.center[3] = 0;
  return frame;
}

/// A turn about the first axis that takes the second along the edge.
struct Turn {
  float c = 1, s = 0;
};
HWY_INLINE Turn turn_along(const float* from, const float* to, const SoupFrame& frame) {
  float u = 0, v = 0;
  for (int l = 0; l < 3; ++l) {
    const float d = (to[l] - from[l]) * frame.scale;
    u += d * frame.axes[l][1], v += d * frame.axes[l][2];
  }
  const float length = std::sqrt(u * u + v * v);
  if (!(length > 0x1p-40f)) return {};
  return {u / length, v / length};
}

HWY_INLINE void turn_axes(const Turn& turn, SoupFrame& frame) {
  // One step of Newton's makes a rotation of numbers that were rounded to float.
  const double c = turn.c, s = turn.s, one = 1.5 - 0.5 * (c * c + s * s);
  for (auto& component : frame.axes) {
    const double u = component[1], v = component[2];
    component[1] = static_cast<float>(one * (c * u + s * v));
    component[2] = static_cast<float>(one * (c * v - s * u));
  }
}

/// Covariance does not determine axes along which the spread is equal: it turns the frame of a square by 45 degrees. So
/// the last two axes are also tried along two edges of a triangle of the sample, one of which is often an edge of the
/// whole shape, and the frame whose box has the least surface is kept. Returns that box.
HWY_INLINE CornerBox<Float4> turn_to_edges(const SoupTriangle* triangles, const SoupSample& sample, SoupFrame& frame) {
  const float* const amid = triangles[sample[sample.size() / 2]].corner;
  const Turn turns[3] = {{}, turn_along(amid, amid + 3, frame), turn_along(amid + 3, amid + 6, frame)};
  // Along eight lines at once: the first axis, and the two others after each turn.
  alignas(32) float lines[3][8] = {};
  for (int l = 0; l < 3; ++l) {
    const float u = frame.axes[l][1] * frame.scale, v = frame.axes[l][2] * frame.scale;
    lines[l][0] = frame.axes[l][0] * frame.scale;
    for (int t = 0; t < 3; ++t) {
      lines[l][1 + 2 * t] = turns[t].c * u + turns[t].s * v;
      lines[l][2 + 2 * t] = turns[t].c * v - turns[t].s * u;
    }
  }
  const Float8 x = Float8::load_aligned(lines[0]), y = Float8::load_aligned(lines[1]),
               z = Float8::load_aligned(lines[2]), center = spread<Float8>(Float4::load(frame.center));
  Float8 lo = Float8::all(0), hi = lo;  // the centre is the mean, so it is inside
  for (std::uint32_t i = 0; i < sample.size(); ++i) {
    const SoupTriangle& triangle = triangles[sample[i]];
    const Corners<Float8> v = corners(triangle, triangle);
    for (const Float8& corner : {v.a, v.b, v.c}) {
      const Float8 d = corner - center;
      const Float8 along = x * d.broadcast<0>() + y * d.broadcast<1>() + z * d.broadcast<2>();
      lo = min(lo, along), hi = max(hi, along);
    }
  }
  float low[8], high[8];
  lo.front().store(low), lo.back().store(low + 4);
  hi.front().store(high), hi.back().store(high + 4);
  const auto size = [&](int line) { return high[line] - low[line]; };
  const auto surface = [&](int t) {
    return size(1 + 2 * t) * size(2 + 2 * t) + (size(1 + 2 * t) + size(2 + 2 * t)) * size(0);
  };
  int best = 0;
  for (int t = 1; t < 3; ++t)
    if (surface(t) < surface(best)) best = t;
  if (best != 0) turn_axes(turns[best], frame);
  const float box[2][4] = {{low[0], low[1 + 2 * best], low[2 + 2 * best], 0},
                           {high[0], high[1 + 2 * best], high[2 + 2 * best], 0}};
  return {Float4::load(box[0]), Float4::load(box[1])};
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // IMPINGE_SOUP_FIT_INL
