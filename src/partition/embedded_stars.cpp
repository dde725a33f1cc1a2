// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/embedded_stars.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "partition/embedded_stars.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/stopped.hpp"
#include "core/strict_arithmetic.hpp"

// Project the triangles of a vertex v along a direction d, and let each of them then be oriented alike, strictly: each
// takes up a sector about v, of an angle between 0 and pi. If v is closed, as many sectors begin at each edge of v as
// end there, so every direction about v that is not an edge's is in the same number of sectors. If that number is 1,
// no two sectors overlap: two triangles share, projected, v or the points of one edge. There one sector ends and one
// begins, so it is a common edge of both, and the only part of either that projects onto it. So the triangles
// themselves share no more than v or a common edge.
//
// The number is that of the sectors which the direction lies in where a coordinate that is constant along d equals v's:
// that of triangles (v, p, q), by their orientation, with p below v on that axis and q not (as often the other way
// round, since v is closed). It is counted by comparing coordinates, exactly, and stays the same while vertices move,
// as long as the orientations do.

#ifndef IMPINGE_EMBEDDED_STARS_SECTORS
#define IMPINGE_EMBEDDED_STARS_SECTORS
namespace impinge::partition {

/// Of a triangle: a bit for each of nine directions, x, y, z, x + y, x - y, y + z, y - z, z + x, z - x, and nine more
/// for their opposites: those along which it is certainly oriented counterclockwise; and for each corner three, for the
/// axes on which the next corner is below it and the one after that is not.
using Sectors = std::uint32_t;
inline constexpr int kDirections = 9, kCorners = 2 * kDirections;
inline constexpr Sectors kAllDirections = (1u << kCorners) - 1;

}  // namespace impinge::partition
#endif

HWY_BEFORE_NAMESPACE();
namespace impinge::partition::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// With u = 2^-53, L at least the coordinates of the edges from the first corner, and each coordinate of a vertex off
/// by at most `slack`: edges are off by h = 2 slack + 2 u L at most, each coordinate of their cross product by
/// 4 h L + 2 h^2, and 4.01 u L^2 for its arithmetic, a sum of two by 8 h L + 4 h^2 + 13 u L^2
/// <= 32 (slack + u L) (L + slack). What underflows is far below slack^2.
void find_sectors(const MeshData& mesh, double slack, std::size_t first, std::size_t end, Sectors* sectors) {
  const hn::CappedTag<double, 8> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  constexpr std::size_t kBlock = 32;
  alignas(64) double rows[9][kBlock] = {};
  alignas(64) std::uint64_t bits[kBlock];
  for (; first < end; first += kBlock) {
    const std::size_t size = std::min(end - first, kBlock);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& v = mesh.vertices[mesh.triangles[first + i][k]];
        rows[3 * k][i] = v.x, rows[3 * k + 1][i] = v.y, rows[3 * k + 2][i] = v.z;
      }
    }
    for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
      auto found = hn::Zero(du);
      const auto set_where = [&](auto mask, int bit) HWY_ATTR {
        found = hn::Or(found, hn::IfThenElseZero(hn::RebindMask(du, mask), hn::Set(du, std::uint64_t{1} << bit)));
      };
      hn::Vec<decltype(d)> a[3], b[3], largest = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis) {
        const auto p = hn::Load(d, rows[axis] + i), q = hn::Load(d, rows[3 + axis] + i),
                   r = hn::Load(d, rows[6 + axis] + i);
        a[axis] = hn::Sub(q, p), b[axis] = hn::Sub(r, p);
        largest = hn::Max(largest, hn::Max(hn::Abs(a[axis]), hn::Abs(b[axis])));
        set_where(hn::And(hn::Lt(q, p), hn::Ge(r, p)), kCorners + axis);
        set_where(hn::And(hn::Lt(r, q), hn::Ge(p, q)), kCorners + 3 + axis);
        set_where(hn::And(hn::Lt(p, r), hn::Ge(q, r)), kCorners + 6 + axis);
      }
      const auto across = [&](int j, int k) HWY_ATTR { return hn::Sub(hn::Mul(a[j], b[k]), hn::Mul(a[k], b[j])); };
      const auto x = across(1, 2), y = across(2, 0), z = across(0, 1), off = hn::Set(d, slack);
      const auto bound = hn::Mul(hn::Mul(hn::Set(d, 32.0), hn::Add(off, hn::Mul(hn::Set(d, 0x1p-53), largest))),
                                 hn::Add(largest, off));
      const hn::Vec<decltype(d)> along[kDirections] = {
          x, y, z, hn::Add(x, y), hn::Sub(x, y), hn::Add(y, z), hn::Sub(y, z), hn::Add(z, x), hn::Sub(z, x)};
      for (int i_direction = 0; i_direction < kDirections; ++i_direction) {
        set_where(hn::Gt(along[i_direction], bound), i_direction);
        set_where(hn::Lt(along[i_direction], hn::Neg(bound)), kDirections + i_direction);
      }
      hn::Store(found, du, bits + i);
    }
    for (std::size_t i = 0; i < size; ++i) sectors[first + i] = static_cast<Sectors>(bits[i]);
  }
}

}  // namespace impinge::partition::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace impinge::partition {

HWY_EXPORT(find_sectors);

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Triangles or vertices between two looks at the stop token, and in one piece of work.
constexpr std::size_t kPiece = 8192;

/// The directions along which x, y, z are constant.
constexpr Sectors kAcross[3] = {0x0cc66, 0x30b85, 0x0361b};

/// What a vertex's triangles have in common: the directions, and on which axes one of them, and more than one, goes
/// from below the vertex to above.
struct Star {
  Sectors directions = ~Sectors{0};  ///< with bits beyond: no triangles
  std::uint8_t once = 0, twice = 0;

  void add(Sectors triangle, int corner) {
    const Sectors up = triangle >> (kCorners + 3 * corner) & 7;
    directions &= triangle & kAllDirections;
    twice = static_cast<std::uint8_t>(twice | (once & up)), once = static_cast<std::uint8_t>(once | up);
  }
  [[nodiscard]] bool is_embedded() const {
    if (directions > kAllDirections) return false;
    for (int axis = 0; axis < 3; ++axis)
      if ((once & ~twice & 1 << axis) != 0 && (directions & kAcross[axis]) != 0) return true;
    return false;
  }
};

/// False of triangles with vertices of their own each, as STL has them: none of those is closed.
bool share_vertices(std::span<const Corners> triangles, std::size_t vertex_count) {
  std::vector<bool> used(vertex_count);
  for (const Corners& c : triangles) {
    for (const std::uint32_t v : c) {
      if (used[v]) return true;
      used[v] = true;
    }
  }
  return false;
}

}  // namespace

std::vector<bool> closed_vertices(std::span<const Corners> triangles, std::size_t vertex_count,
                                  const std::stop_token& stop) {
  if (!share_vertices(triangles, vertex_count)) return {};
  // By the smaller vertex first, which are counted; then the few of each.
  struct Side {
    std::uint32_t larger;
    std::int32_t sign;  ///< 1: from the smaller to the larger vertex
  };
  const auto for_each_side = [&](const auto& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (t % kPiece == 0) throw_if_stopped(stop);
      const Corners& c = triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = c[k], to = c[k == 2 ? 0 : k + 1];
        visit(std::min(from, to), Side{std::max(from, to), from < to ? 1 : -1});
      }
    }
  };
  std::vector<std::size_t> ends(vertex_count + 1);  // of each vertex; while they are put, where the next comes
  for_each_side([&](std::uint32_t smaller, const Side&) { ++ends[smaller + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Side> all(ends.back());
  for_each_side([&](std::uint32_t smaller, const Side& side) { all[ends[smaller]++] = side; });
  std::vector<bool> closed(vertex_count, true);
  std::vector<std::int32_t> excess(vertex_count);  // of each side of the vertex at hand; else 0
  auto next = all.begin();
  for (std::size_t smaller = 0; smaller < vertex_count; ++smaller) {
    if (smaller % kPiece == 0) throw_if_stopped(stop);
    const auto first = next, end = all.begin() + static_cast<std::ptrdiff_t>(ends[smaller]);
    for (auto side = first; side != end; ++side) excess[side->larger] += side->sign;
    for (; next != end; ++next)
      if (std::exchange(excess[next->larger], 0) != 0) closed[smaller] = closed[next->larger] = false;
  }
  if (std::find(closed.begin(), closed.end(), true) == closed.end()) return {};
  return closed;
}

bool may_have_embedded_stars(const MeshData& mesh) {
  const double size = max_component(mesh.max_abs);
  // Without overflow, and with a square of the slack that is far above what underflows.
  return size > 0x1p-301 && size < 0x1p301 && std::max(mesh.vertices.size(), mesh.triangles.size()) <= kMostStars;
}

EmbeddedStars find_embedded_stars(const MeshData& mesh, const std::vector<bool>& closed, const ForEach& for_each,
                                  const std::stop_token& stop) {
  if (closed.empty() || !may_have_embedded_stars(mesh)) return {};
  EmbeddedStars result;
  result.slack = 0x1p-38 * max_component(mesh.max_abs);
  const std::size_t count = mesh.triangles.size(), pieces = (count + kPiece - 1) / kPiece;
  const auto end_of = [&](std::size_t piece) { return std::min((piece + 1) * kPiece, count); };
  std::vector<Sectors> sectors(count);
  run_each(for_each, pieces, [&](std::size_t piece) {
    throw_if_stopped(stop);
    HWY_DYNAMIC_DISPATCH(find_sectors)(mesh, result.slack, piece * kPiece, end_of(piece), sectors.data());
  });
  std::vector<Star> stars(mesh.vertices.size());
  for (std::size_t t = 0; t < count; ++t) {
    if (t % kPiece == 0) throw_if_stopped(stop);
    for (int k = 0; k < 3; ++k) stars[mesh.triangles[t][static_cast<std::size_t>(k)]].add(sectors[t], k);
  }
  std::vector<std::uint32_t> names(stars.size(), EmbeddedStars::kNone);
  bool any = false;
  for (std::uint32_t v = 0; v < names.size(); ++v)
    if (closed[v] && stars[v].is_embedded()) names[v] = v, any = true;
  if (!any) return result;
  result.corners.resize(count);
  run_each(for_each, pieces, [&](std::size_t piece) {
    throw_if_stopped(stop);
    for (std::size_t t = piece * kPiece; t < end_of(piece); ++t)
      for (std::size_t k = 0; k < 3; ++k) result.corners[t][k] = names[mesh.triangles[t][k]];
  });
  return result;
}

}  // namespace impinge::partition
#endif  // HWY_ONCE
