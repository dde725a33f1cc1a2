// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/make_leaf.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/vec3.hpp"
#include "hierarchy/carried_axes.hpp"
#include "hierarchy/round_up.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/make_leaf.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hierarchy/soup_fit-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

/// The origin becomes the middle of the box.
HWY_INLINE void place(const CornerBox<Float4>& box, const Vec3& base, const SoupFrame& fit, Frame& frame) {
  float middle[4];
  ((box.lo + box.hi) * Float4::all(0.5f)).store(middle);
  const double bases[3] = {base.x, base.y, base.z}, unscale = 1 / double{fit.scale};
  for (int l = 0; l < 3; ++l) {
    double offset = fit.center[l];
    for (int i = 0; i < 3; ++i) offset += unscale * (double{fit.axes[l][i]} * double{middle[i]});
    frame.origin[l] = bases[l] + offset;
    std::copy(fit.axes[l], fit.axes[l] + 4, frame.axes[l]);
  }
  frame.origin[3] = 0;
}

/// Rotates `3 * stride` points, given as rows of x, y and z, into the rows of a leaf. `reach` becomes the largest
/// coordinate on each axis.
HWY_INLINE void rotate(const double* points, std::size_t stride, const Frame& frame, float* rows, float* reach) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> df;
  const std::size_t size = 3 * stride;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto x = hn::Set(d, frame.axes[0][i]), y = hn::Set(d, frame.axes[1][i]), z = hn::Set(d, frame.axes[2][i]);
    auto most = hn::Zero(df);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double* from = points + corner * stride;
      float* to = rows + (3 * corner + i) * stride;
      for (std::size_t j = 0; j < stride; j += hn::Lanes(d)) {
        const auto sum = hn::Add(hn::Add(hn::Mul(x, hn::Load(d, from + j)), hn::Mul(y, hn::Load(d, from + size + j))),
                                 hn::Mul(z, hn::Load(d, from + 2 * size + j)));
        const auto rounded = hn::DemoteTo(df, sum);
        hn::Store(rounded, df, to + j);
        most = hn::Max(most, hn::Abs(rounded));
      }
    }
    float lanes[8];
    hn::StoreU(most, df, lanes);
    reach[i] = *std::max_element(lanes, lanes + hn::Lanes(df));
  }
}

/// Everything but the bounds, from the mesh's doubles. The vertices are prefetched while the axes are computed.
void write(const SoupTriangle* triangles, const Vec3& base, const SoupSource& source, WideLeaf& leaf, float* reach) {
  const std::size_t count = leaf.count, stride = leaf.stride, size = 3 * stride;
  auto* const rows = reinterpret_cast<float*>(&leaf + 1);
  auto* const ids = reinterpret_cast<std::uint32_t*>(rows + 9 * stride);
  const auto* const indices = source.mesh.triangles.data();
  const auto* const vertices = source.mesh.vertices.data();
  for (std::size_t j = 0; j < count; ++j) {
    ids[j] = triangles[j].id;
    hwy::Prefetch(indices + ids[j]);
  }
  const SoupSample all(count, leaf.count);
  SoupFrame fit = fit_frame(triangles, all);
  for (std::size_t j = 0; j < count; ++j)
    for (const std::uint32_t v : indices[ids[j]]) hwy::Prefetch(vertices + v);
  place(turn_to_edges(triangles, all, fit), base, fit, leaf.frame);

  alignas(64) double points[3 * 3 * kMostTriangles];
  const double x = leaf.frame.origin[0], y = leaf.frame.origin[1], z = leaf.frame.origin[2];
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 v = source.corner(ids[j], corner);
      double* const to = points + corner * stride + j;
      to[0] = v.x - x, to[size] = v.y - y, to[2 * size] = v.z - z;
    }
  }
  for (std::size_t j = count; j < stride; ++j)
    for (std::size_t row = 0; row < 9; ++row) points[row * stride + j] = 0;
  rotate(points, stride, leaf.frame, rows, reach);
  for (std::size_t j = count; j < stride; ++j) {
    for (std::size_t row = 0; row < 9; ++row) rows[row * stride + j] = WideLeaf::kNoTriangle;
    ids[j] = 0;
  }
}

/// The middle of the box of `size` points, rows of x, y and z that are turned to the frame's axes in place. Those at 0
/// are inside.
HWY_INLINE void turn(double* points, std::size_t size, const Frame& frame, double* middle) {
  const hn::CappedTag<double, 8> d;
  auto lo_x = hn::Zero(d), lo_y = lo_x, lo_z = lo_x, hi_x = lo_x, hi_y = lo_x, hi_z = lo_x;
  const auto entry = [&](int l, int i) HWY_ATTR { return hn::Set(d, frame.axes[l][i]); };
  const auto xx = entry(0, 0), xy = entry(1, 0), xz = entry(2, 0), yx = entry(0, 1), yy = entry(1, 1), yz = entry(2, 1),
             zx = entry(0, 2), zy = entry(1, 2), zz = entry(2, 2);
  for (std::size_t j = 0; j < size; j += hn::Lanes(d)) {
    const auto x = hn::Load(d, points + j), y = hn::Load(d, points + size + j), z = hn::Load(d, points + 2 * size + j);
    const auto along = [&](auto ax, auto ay, auto az)
                           HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, x), hn::Mul(ay, y)), hn::Mul(az, z)); };
    const auto u = along(xx, xy, xz), v = along(yx, yy, yz), w = along(zx, zy, zz);
    hn::Store(u, d, points + j), hn::Store(v, d, points + size + j), hn::Store(w, d, points + 2 * size + j);
    lo_x = hn::Min(lo_x, u), lo_y = hn::Min(lo_y, v), lo_z = hn::Min(lo_z, w);
    hi_x = hn::Max(hi_x, u), hi_y = hn::Max(hi_y, v), hi_z = hn::Max(hi_z, w);
  }
  const auto between = [&](auto lo, auto hi) HWY_ATTR {
    return 0.5 * (hn::GetLane(hn::MinOfLanes(d, lo)) + hn::GetLane(hn::MaxOfLanes(d, hi)));
  };
  middle[0] = between(lo_x, hi_x), middle[1] = between(lo_y, hi_y), middle[2] = between(lo_z, hi_z);
}

/// Everything but the bounds, from the mesh's doubles. Each vertex is turned once.
void rewrite(const RefitPlan& plan, const RefitPlan::Leaf& planned, const SoupSource& source, WideLeaf& leaf,
             float* reach) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> df;
  const std::size_t count = leaf.count, stride = leaf.stride;
  const std::span vertices = plan.list(planned.vertices);
  const std::size_t size = (vertices.size() + 7) / 8 * 8;
  alignas(64) double points[3 * 3 * kMostTriangles];  // from the first; beyond the last, there
  const Vec3 near = source.vertex(vertices[0]);
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec3 v = source.vertex(vertices[j]);
    points[j] = v.x - near.x, points[size + j] = v.y - near.y, points[2 * size + j] = v.z - near.z;
  }
  for (std::size_t j = vertices.size(); j < size; ++j) points[j] = points[size + j] = points[2 * size + j] = 0;

  const std::span samples = std::span(plan.samples).subspan(planned.axes.first_sample, planned.axes.samples);
  Vec3 sampled[RefitPlan::kMostSamples];
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double* const at = points + (samples[k].place - planned.vertices.first);
    sampled[k] = {at[0], at[size], at[2 * size]};
  }
  carry_axes(planned.axes, samples, sampled, leaf.frame);
  double middle[3];
  turn(points, size, leaf.frame, middle);

  const auto& axes = leaf.frame.axes;
  const double from[3] = {near.x, near.y, near.z};
  double move[3];
  for (int l = 0; l < 3; ++l) {
    const double offset = axes[l][0] * middle[0] + axes[l][1] * middle[1] + axes[l][2] * middle[2];
    leaf.frame.origin[l] = from[l] + offset;
    move[l] = leaf.frame.origin[l] - from[l];
  }
  leaf.frame.origin[3] = 0;
  alignas(64) float moved[3][3 * kMostTriangles];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto shift = hn::Set(d, axes[0][i] * move[0] + axes[1][i] * move[1] + axes[2][i] * move[2]);
    auto most = hn::Zero(df);
    for (std::size_t j = 0; j < size; j += hn::Lanes(d)) {
      const auto rounded = hn::DemoteTo(df, hn::Sub(hn::Load(d, points + i * size + j), shift));
      most = hn::Max(most, hn::Abs(rounded));
      hn::Store(rounded, df, moved[i] + j);
    }
    reach[i] = hn::GetLane(hn::MaxOfLanes(df, most));
  }

  auto* const rows = reinterpret_cast<float*>(&leaf + 1);
  auto* const ids = reinterpret_cast<std::uint32_t*>(rows + 9 * stride);
  const std::uint16_t* places = plan.corners.data() + planned.corners;
  for (std::size_t corner = 0; corner < 3; ++corner, places += count) {
    float* const to = rows + 3 * corner * stride;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t place = places[j];
      to[j] = moved[0][place], to[stride + j] = moved[1][place], to[2 * stride + j] = moved[2][place];
    }
  }
  for (std::size_t j = 0; j < count; ++j) ids[j] = plan.order[planned.first + j];
  for (std::size_t j = count; j < stride; ++j) {
    for (std::size_t row = 0; row < 9; ++row) rows[row * stride + j] = WideLeaf::kNoTriangle;
    ids[j] = 0;
  }
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {
HWY_EXPORT(write);
HWY_EXPORT(rewrite);
namespace {

/// Rows in whole vectors of the most lanes that a reader takes.
std::uint32_t stride_for(std::uint32_t count) { return (count + 15) / 16 * 16; }

/// How far F⁻¹x may be from Fᵀx for |x| <= 1: F⁻¹ = Fᵀ (I + E)⁻¹ with E = F Fᵀ - I, so the difference is at most
/// sqrt(1 + |E|) |E| / (1 - |E|), and |E| < 2^-20. E is computed to within 2^-50.
double inverse_defect(const Frame& frame) {
  double squares = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double e = i == j ? -1 : 0;
      for (int l = 0; l < 3; ++l) e += double{frame.axes[l][i]} * double{frame.axes[l][j]};
      squares += e * e;
    }
  }
  return (std::sqrt(squares) + 0x1p-48) * (1 + 0x1p-18);
}

WideLeaf* new_leaf(std::uint32_t count, Arena& arena) {
  const std::size_t stride = stride_for(count);
  auto* const leaf = new (arena.allocate(sizeof(WideLeaf) + 10 * stride * sizeof(float))) WideLeaf;
  leaf->count = count, leaf->stride = static_cast<std::uint32_t>(stride);
  return leaf;
}

/// The bounds, by the largest coordinate on each axis.
//
// Let L be the largest of them. Made anew, a corner is rotated by three products and two sums in double from a
// difference of at most 2 L, rounded once: less than 2^-50 L. Refitted, it and the origin are rotated from a corner of
// the leaf, at most 2 sqrt 3 L and sqrt 3 L away: each is rounded once by the difference and five times by the
// rotation, where no number is above sqrt 3 times as much, then once more by their difference: less than 64 * 2^-53 L.
// Then each number is rounded to float, which is 2^-24 of it or, near nothing, 2^-150. Likewise 2^-k v may have been
// rounded near nothing.
void set_bounds(const float (&reach)[3], WideLeaf& leaf) {
  const double largest = std::max({reach[0], reach[1], reach[2]});
  const double error = (0x1p-24 + 0x1p-46) * largest + kNothing;
  for (int i = 0; i < 3; ++i) leaf.half[i] = round_up(reach[i] + error);
  leaf.error = round_up(error);
  leaf.inverse_error = round_up(inverse_defect(leaf.frame) * norm(Vec3{reach[0], reach[1], reach[2]}));
  leaf.frame.radius = round_up(largest + error);
}

}  // namespace

const WideLeaf* make_leaf(std::span<const SoupTriangle> triangles, const Vec3& base, const SoupSource& source,
                          Arena& arena) {
  WideLeaf* const leaf = new_leaf(static_cast<std::uint32_t>(triangles.size()), arena);
  float reach[3];
  HWY_DYNAMIC_DISPATCH(write)(triangles.data(), base, source, *leaf, reach);
  set_bounds(reach, *leaf);
  return leaf;
}

const WideLeaf* refit_leaf(const RefitPlan& plan, const RefitPlan::Leaf& planned, const SoupSource& source,
                           Arena& arena) {
  WideLeaf* const leaf = new_leaf(planned.count, arena);
  float reach[3];
  HWY_DYNAMIC_DISPATCH(rewrite)(plan, planned, source, *leaf, reach);
  set_bounds(reach, *leaf);
  return leaf;
}

}  // namespace impinge::hierarchy
#endif  // HWY_ONCE
