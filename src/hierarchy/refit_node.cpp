// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/refit_node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hierarchy/carried_axes.hpp"
#include "hierarchy/round_up.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/refit_node.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// No fused operations here: the tree is the same on every instruction set.
HWY_BEFORE_NAMESPACE();
namespace impinge::hierarchy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The box of vertices along a frame's axes, about its origin.
void bound_vertices(std::span<const std::uint32_t> vertices, const SoupSource& source, const Frame& frame, double* low,
                    double* high) {
  const hn::CappedTag<double, 8> d;
  constexpr std::size_t kBlock = 64;
  alignas(64) double points[3][kBlock];
  const auto entry = [&](int l, int i) HWY_ATTR { return hn::Set(d, double{frame.axes[l][i]}); };
  const auto xx = entry(0, 0), xy = entry(1, 0), xz = entry(2, 0), yx = entry(0, 1), yy = entry(1, 1), yz = entry(2, 1),
             zx = entry(0, 2), zy = entry(1, 2), zz = entry(2, 2);
  auto lo_x = hn::Set(d, kInfinity), lo_y = lo_x, lo_z = lo_x, hi_x = hn::Neg(lo_x), hi_y = hi_x, hi_z = hi_x;
  const Vec3 origin{frame.origin[0], frame.origin[1], frame.origin[2]};
  for (std::size_t begin = 0; begin < vertices.size(); begin += kBlock) {
    const std::size_t size = std::min(kBlock, vertices.size() - begin);
    for (std::size_t j = 0; j < size; ++j) {
      const Vec3 p = source.vertex(vertices[begin + j]) - origin;
      points[0][j] = p.x, points[1][j] = p.y, points[2][j] = p.z;
    }
    const std::size_t whole = (size + hn::Lanes(d) - 1) / hn::Lanes(d) * hn::Lanes(d);
    for (std::size_t j = size; j < whole; ++j)
      for (auto& row : points) row[j] = row[0];
    for (std::size_t j = 0; j < whole; j += hn::Lanes(d)) {
      const auto x = hn::Load(d, points[0] + j), y = hn::Load(d, points[1] + j), z = hn::Load(d, points[2] + j);
      const auto along = [&](auto ax, auto ay, auto az)
                             HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, x), hn::Mul(ay, y)), hn::Mul(az, z)); };
      const auto u = along(xx, xy, xz), v = along(yx, yy, yz), w = along(zx, zy, zz);
      lo_x = hn::Min(lo_x, u), lo_y = hn::Min(lo_y, v), lo_z = hn::Min(lo_z, w);
      hi_x = hn::Max(hi_x, u), hi_y = hn::Max(hi_y, v), hi_z = hn::Max(hi_z, w);
    }
  }
  low[0] = hn::GetLane(hn::MinOfLanes(d, lo_x)), high[0] = hn::GetLane(hn::MaxOfLanes(d, hi_x));
  low[1] = hn::GetLane(hn::MinOfLanes(d, lo_y)), high[1] = hn::GetLane(hn::MaxOfLanes(d, hi_y));
  low[2] = hn::GetLane(hn::MinOfLanes(d, lo_z)), high[2] = hn::GetLane(hn::MaxOfLanes(d, hi_z));
}

}  // namespace impinge::hierarchy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::hierarchy {
HWY_EXPORT(bound_vertices);
namespace {

/// Children of nodes with more triangles are bounded by several threads.
constexpr std::uint32_t kShared = 1 << 14;

/// How far from exact a computed coordinate may be, of vertices that reach so far from the origin: a difference d is
/// rounded, each of three products and two sums is, and none of these is above sqrt 3 |d|: less than 2^-49 of the
/// reach.
double slack(double reach) { return 0x1p-45 * reach + kNothing; }

/// Amid the samples, by their differences: a mean of coordinates is off by their last place, which far away is more
/// than the node's size.
void set_frame(const RefitPlan& plan, const RefitPlan::Axes& axes, const SoupSource& source, Frame& frame) {
  const std::span samples = std::span(plan.samples).subspan(axes.first_sample, axes.samples);
  std::array<Vec3, RefitPlan::kMostSamples> points{};
  Vec3 sum{};
  for (std::size_t k = 0; k < samples.size(); ++k) {
    points[k] = source.vertex(plan.vertices[samples[k].place]);
    sum = sum + (points[k] - points[0]);
  }
  const Vec3 origin = points[0] + (1.0 / static_cast<double>(samples.size())) * sum;
  frame.origin[0] = origin.x, frame.origin[1] = origin.y, frame.origin[2] = origin.z, frame.origin[3] = 0;
  carry_axes(axes, samples, points.data(), frame);
}

}  // namespace

void refit_node(const RefitPlan& plan, const RefitPlan::Node& planned, const SoupSource& source, WideNode& node,
                const ForEach& for_each) {
  node.size = planned.size, node.depth = planned.depth;
  set_frame(plan, planned.axes, source, node.frame);
  double low[kWidth][3] = {}, high[kWidth][3] = {};
  const std::uint32_t triangles = planned.first[planned.size - 1] + planned.count[planned.size - 1] - planned.first[0];
  run_each(triangles > kShared ? for_each : ForEach(), planned.size, [&](std::size_t lane) {
    HWY_DYNAMIC_DISPATCH(bound_vertices)(plan.list(planned.vertices[lane]), source, node.frame, low[lane], high[lane]);
  });
  double radius = 0;
  for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
    const bool is_used = lane < planned.size;
    node.child[lane].store(0, std::memory_order_relaxed);
    node.first[lane] = is_used ? planned.first[lane] : 0, node.count[lane] = is_used ? planned.count[lane] : 0;
    double reach = 0;
    for (int i = 0; i < 3; ++i) reach = std::max({reach, -low[lane][i], high[lane][i]});
    const double margin = slack(reach);
    radius = std::max(radius, reach + margin);
    for (int i = 0; i < 3; ++i) {
      const double lo = low[lane][i], hi = high[lane][i];
      const float middle = static_cast<float>(0.5 * (lo + hi)) + 0.0f;  // no -0, of which min and max may take either
      node.center[i][lane] = middle;
      node.half[i][lane] = is_used ? round_up(std::max(hi - middle, middle - lo) + margin) : kNoBox;
    }
  }
  node.frame.radius = round_up(radius);
}

}  // namespace impinge::hierarchy
#endif  // HWY_ONCE
