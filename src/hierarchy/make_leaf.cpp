// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/make_leaf.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/vec3.hpp"
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

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {
HWY_EXPORT(write);
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

}  // namespace

const WideLeaf* make_leaf(std::span<const SoupTriangle> triangles, const Vec3& base, const SoupSource& source,
                          Arena& arena) {
  const auto count = static_cast<std::uint32_t>(triangles.size());
  const std::size_t stride = stride_for(count);
  auto* const leaf = new (arena.allocate(sizeof(WideLeaf) + 10 * stride * sizeof(float))) WideLeaf;
  leaf->count = count, leaf->stride = static_cast<std::uint32_t>(stride);
  float reach[3];
  HWY_DYNAMIC_DISPATCH(write)(triangles.data(), base, source, *leaf, reach);

  // The rotation in double is off by less than 2^-50 of the largest coordinate before it, which is at most twice the
  // largest after it; then each number is rounded to float, which is 2^-24 of it or, near nothing, 2^-150. Likewise
  // 2^-k v may have been rounded near nothing.
  const double largest = std::max({reach[0], reach[1], reach[2]});
  const double error = (0x1p-24 + 0x1p-48) * largest + kNothing;
  for (int i = 0; i < 3; ++i) leaf->half[i] = round_up(reach[i] + error);
  leaf->error = round_up(error);
  leaf->inverse_error = round_up(inverse_defect(leaf->frame) * norm(Vec3{reach[0], reach[1], reach[2]}));
  leaf->frame.radius = round_up(largest + error);
  return leaf;
}

}  // namespace impinge::hierarchy
#endif  // HWY_ONCE
