// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

using Profile = std::vector<std::array<double, 2>>;

/// What a polyline in the xz plane sweeps along y, cut at these coordinates; each strip with vertices of its own unless
/// `shared`, and diagonals one way or the other.
MeshData swept(const Profile& profile, const std::vector<double>& y, bool other_diagonals = false) {
  MeshData mesh;
  for (const double at : y)
    for (const auto& [x, z] : profile) mesh.xyz.insert(mesh.xyz.end(), {x, at, z});
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t j = 0; j + 1 < y.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t p = j * n + i, q = p + 1, r = q + n, s = p + n;
      if (other_diagonals)
        mesh.triangles.insert(mesh.triangles.end(), {p, q, s, q, r, s});
      else
        mesh.triangles.insert(mesh.triangles.end(), {p, q, r, p, r, s});
    }
  }
  return mesh;
}

MeshData triangles(std::vector<double> xyz, std::vector<std::uint32_t> corners) {
  MeshData mesh;
  mesh.xyz = std::move(xyz), mesh.triangles = std::move(corners);
  return mesh;
}

void add_lines(std::vector<SolidPair>& pairs) {
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name, a, b, known, false});
  };
  const std::vector<double> whole{0, 8}, within{2, 6}, cut{0, 3, 8}, cut_otherwise{0, 2, 5, 8};
  const Profile flat{{-4, 0}, {0, 0}, {4, 0}}, upright{{0, -4}, {0, 0}, {0, 4}}, bent{{-4, 1}, {0, 0}, {4, 2}};
  const MeshData floor = swept(flat, whole);
  add("along an edge of both", floor, swept(upright, whole), kCrossing);
  add("along an edge of both, inverted", inverted(floor), swept(upright, whole, true), kCrossing);
  add("along edges of both, cut alike", swept(flat, cut), swept(upright, cut), kCrossing);
  add("along edges of both, cut otherwise", swept(flat, cut), swept(upright, cut_otherwise), kCrossing);
  add("along a part of an edge", floor, swept(upright, within), kCrossing);
  add("along edges that overlap", floor, swept(upright, {4, 12}), kCrossing);
  add("along an edge of one", swept({{-4, 0}, {4, 0}}, whole), swept(upright, whole), kCrossing);
  add("along an edge of one, wide", swept({{-4, 0}, {4, 0}}, {-2, 10}), swept(upright, within), kCrossing);
  add("along an edge of the other", floor, swept({{0, -4}, {0, 4}}, within), kCrossing);
  add("both bent", swept(bent, whole), swept({{-1, -4}, {0, 0}, {2, 4}}, whole), kCrossing);
  add("both bent, aslant", swept(bent, whole), swept({{4, 1}, {0, 0}, {-4, 2}}, whole), kCrossing);
  add("both bent, at a flat angle", swept(bent, whole), swept({{-4, 0.5}, {0, 0}, {4, 2.5}}, whole), kCrossing);
  add("a fold on a sheet", floor, swept({{-3, 4}, {0, 0}, {3, 4}}, whole), kTouching);
  add("a fold on a sheet, cut otherwise", swept(flat, cut), swept({{-3, 4}, {0, 0}, {3, 4}}, cut_otherwise), kTouching);
  add("a fold on the inside of a sheet", swept({{-4, 0}, {4, 0}}, {-2, 10}), swept({{-3, 4}, {0, 0}, {3, 4}}, whole),
      kTouching);
  add("a fold in a fold", swept({{-4, 4}, {0, 0}, {4, 4}}, whole), swept({{-2, 4}, {0, 0}, {2, 4}}, whole), kTouching);
  add("a fold beside a fold", swept({{-4, 1}, {0, 0}, {-4, -1}}, whole), swept({{4, 1}, {0, 0}, {4, -1}}, whole),
      kTouching);
  add("a fold that half lies on a sheet", floor, swept({{-4, 0}, {0, 0}, {3, 4}}, whole), kTouching);
  add("an end on an edge", floor, swept({{0, 0}, {0, 4}}, whole), kTouching);
  add("an end on an edge, cut otherwise", swept(flat, cut), swept({{0, 0}, {0, 4}}, cut_otherwise), kTouching);
  add("an edge on an end", swept({{0, 0}, {4, 0}}, whole), swept(upright, whole), kTouching);
  add("an end on an end", swept({{0, 0}, {4, 0}}, whole), swept({{0, 0}, {0, 4}}, whole), kTouching);
  // Four flaps around a line, of which each touches the next.
  const MeshData cross = joined(joined(swept({{0, 0}, {4, 0}}, whole), swept({{0, 0}, {-4, 0}}, whole)),
                                joined(swept({{0, 0}, {0, 4}}, whole), swept({{0, 0}, {0, -4}}, whole)));
  add("through the middle of a cross", cross, swept({{-4, -4}, {0, 0}, {4, 4}}, whole), kCrossing);
  add("through the middle of a cross, cut there", cross, swept({{-4, -4}, {4, 4}}, whole), kCrossing);
  add("in a corner of a cross", cross, swept({{2, 4}, {0, 0}, {4, 2}}, whole), kTouching);
  add("an end in a corner of a cross", cross, swept({{0, 0}, {4, 4}}, whole), kTouching);
}

/// A path that runs on edges here and through triangles there; places that are points, or areas.
void add_mixed(std::vector<SolidPair>& pairs) {
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name, a, b, known, false});
  };
  const std::vector<double> whole{0, 8};
  const MeshData floor = swept({{-4, 0}, {0, 0}, {4, 0}}, whole);
  const MeshData upright =
      triangles({0, 0, 0, 0, 4, 0, 2, 8, 0, 0, 0, 4, 0, 4, 4, 2, 8, 4, 0, 0, -4, 0, 4, -4, 2, 8, -4},
                {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 6, 7, 1, 6, 1, 0, 7, 8, 2, 7, 2, 1});
  add("on an edge, then through triangles", floor, upright, kCrossing);
  add("on an edge, then through triangles, an end", floor, triangles(upright.xyz, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}),
      kTouching);
  add("through a vertex of both, not along an edge",
      triangles({-4, -4, 0, 4, -4, 0, 4, 4, 0, -4, 4, 0, 0, 0, 0}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}),
      triangles({-4, 0, -4, 4, 0, -4, 4, 0, 4, -4, 0, 4, 0, 0, 0}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}), kCrossing);
  add("through a vertex of both, along edges",
      triangles({-4, 0, 0, 0, -4, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}),
      triangles({-4, 0, 0, 0, 0, -4, 4, 0, 0, 0, 0, 4, 0, 0, 0}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}), kCrossing);
  add("tips that meet", triangles({-4, -4, 8, 4, -4, 8, 0, 4, 8, 0, 0, 0}, {0, 1, 3, 1, 2, 3, 2, 0, 3}),
      triangles({-4, -4, -8, 4, -4, -8, 0, 4, -8, 0, 0, 0}, {0, 1, 3, 1, 2, 3, 2, 0, 3}), kTouching);
  // Each with a notch towards the other, deep to a common point.
  const MeshData notched = triangles({0, 0, 0, 4, 4, 0, -4, 4, 0, -4, -4, 0, 4, -4, 0}, {0, 1, 2, 0, 2, 3, 0, 3, 4});
  add("notches in each other", notched,
      triangles({0, 0, 0, -4, 0, 4, 4, 0, 4, 4, 0, -4, -4, 0, -4}, {0, 1, 2, 0, 2, 3, 0, 3, 4}), kTouching);
  add("a sheet over a notch", notched, swept({{0, 0}, {4, 0}}, {-1, 1}), kTouching);
  // A web that lies on the other sheet, or through it.
  const Profile both{{-4, 0}, {-1, 0}, {1, 0}, {4, 0}};
  const Profile up_and_down{{-1, 4}, {-1, 0}, {1, 0}, {1, -4}}, up{{-1, 4}, {-1, 0}, {1, 0}, {1, 4}};
  add("comes from above, goes below", swept(both, whole), swept(up_and_down, whole), kCrossing);
  add("comes from above, goes below, on one triangle", swept({{-4, 0}, {4, 0}}, {-2, 10}), swept(up_and_down, {1, 5}),
      kCrossing);
  add("comes from above, goes back up", swept(both, whole), swept(up, whole), kTouching);
  add("comes from above, stays", swept(both, whole), swept({{-1, 4}, {-1, 0}, {1, 0}}, whole), kTouching);
  add("around an end", swept({{-4, 0}, {-1, 0}, {1, 0}}, whole), swept(up_and_down, whole), kTouching);
  add("around an end, on one triangle", swept({{-4, 0}, {1, 0}}, {-2, 10}), swept(up_and_down, {1, 5}), kTouching);
  add("on both sides, one beside the other", swept(both, whole),
      joined(swept({{-1, 0}, {-1, 4}}, whole), swept({{1, 0}, {1, -4}}, whole)), kTouching);
  add("hooks from below and above", swept(both, whole),
      joined(swept({{-3, 0}, {-1, 0}, {-1, 4}}, {1, 3}), swept({{3, 0}, {1, 0}, {1, -4}}, {5, 7})), kTouching);
}

/// Triangles without an area: segments and points.
MeshData segment(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return triangles({p[0], p[1], p[2], q[0], q[1], q[2]}, {0, 1, 1});
}
MeshData point(const std::array<double, 3>& p) { return triangles({p[0], p[1], p[2]}, {0, 0, 0}); }

}  // namespace

std::vector<SolidPair> degenerate_pairs() {
  std::vector<SolidPair> pairs;
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name, a, b, known, false});
  };
  const MeshData solid = box({0, 0, 0}, {8, 8, 8}), hollow = joined(solid, inverted(box({2, 2, 2}, {6, 6, 6})));
  add("a segment in a solid", segment({2, 2, 2}, {6, 5, 4}), solid, kInner);
  add("a segment in a solid, of three corners", triangles({2, 2, 2, 6, 6, 4, 4, 4, 3}, {0, 1, 2}), solid, kInner);
  add("a segment in a solid, from wall to wall", segment({0, 3, 2}, {8, 5, 4}), solid, kInner);
  add("a segment in a solid, from corner to corner", segment({0, 0, 0}, {8, 8, 8}), solid, kInner);
  add("a segment in a solid, an end on a face", segment({2, 3, 5}, {2, 3, 8}), solid, kInner);
  add("a segment half in a solid", segment({2, 3, 5}, {2, 3, 11}), solid, kCrossing);
  add("a segment through a solid", segment({-3, 3, 5}, {11, 4, 6}), solid, kCrossing);
  add("a segment through two edges of a solid", segment({-2, 4, -2}, {10, 4, 10}), solid, kCrossing);
  add("a segment through two corners of a solid", segment({-2, -2, -2}, {10, 10, 10}), solid, kCrossing);
  add("a segment in a wall", segment({1, 1, 1}, {1, 7, 1}), hollow, kInner);
  add("a segment in a wall and the cavity", segment({1, 3, 3}, {4, 4, 4}), hollow, kCrossing);
  add("a segment across the cavity", segment({2, 3, 3}, {6, 4, 4}), hollow, kTouching);
  add("a segment free in the cavity", segment({3, 3, 3}, {5, 4, 4}), hollow, kApart);
  add("a segment on a face", segment({2, 3, 8}, {6, 5, 8}), solid, kTouching);
  add("a segment on a face and beyond", segment({2, 3, 8}, {11, 5, 8}), solid, kTouching);
  add("a segment on an edge", segment({0, -2, 8}, {0, 12, 8}), solid, kTouching);
  add("a segment's end on a face", segment({2, 3, 8}, {2, 3, 11}), solid, kTouching);
  add("a segment past an edge", segment({-2, 4, 6}, {2, 4, 10}), solid, kTouching);
  add("a segment above a face", segment({2, 3, 8.5}, {6, 5, 8.5}), solid, kApart);
  add("a segment in a row of blocks", segment({-2, 4, 4}, {10, 4, 4}), block({-4, 0, 4, 12}, {0, 8}, {0, 8}), kInner);
  const MeshData sheet_in = sheet({2, 6}, {2, 6}, 4), sheet_out = sheet({2, 6}, {2, 6}, 11);
  add("a sheet and a segment in a solid", joined(sheet_in, segment({2, 2, 4}, {1, 1, 7})), solid, kInner);
  add("a sheet in a solid, a spike out of it", joined(sheet_in, segment({2, 2, 4}, {2, 3, 11})), solid, kCrossing);
  add("a sheet in a solid, a segment outside", joined(sheet_in, segment({2, 2, 10}, {2, 3, 11})), solid, kCrossing);
  add("a sheet outside, a spike into a solid", joined(sheet_out, segment({2, 2, 11}, {2, 3, 4})), solid, kCrossing);
  add("a sheet on a face, a spike into the solid", joined(sheet({2, 6}, {2, 6}, 8), segment({2, 2, 8}, {2, 3, 4})),
      solid, kInner);
  add("a sheet on a face, a spike out", joined(sheet({2, 6}, {2, 6}, 8), segment({2, 2, 8}, {2, 3, 11})), solid,
      kTouching);
  add("a segment through a sheet", segment({4, 4, 0}, {4, 4, 8}), sheet_in, kTouching);
  add("a segment in a sheet", segment({3, 3, 4}, {5, 4, 4}), sheet_in, kTouching);
  add("segments, the same", segment({2, 2, 2}, {6, 5, 4}), segment({6, 5, 4}, {2, 2, 2}), kDuplicate);
  add("segments, the same, cut", segment({2, 2, 2}, {6, 6, 4}),
      joined(segment({2, 2, 2}, {5, 5, 3.5}), segment({4, 4, 3}, {6, 6, 4})), kDuplicate);
  add("segments, one on the other", segment({2, 2, 2}, {6, 6, 4}), segment({4, 4, 3}, {6, 6, 4}), kTouching);
  add("segments that cross", segment({2, 2, 2}, {6, 6, 2}), segment({2, 6, 2}, {6, 2, 2}), kTouching);
  add("segments apart", segment({2, 2, 2}, {6, 6, 2}), segment({2, 6, 3}, {6, 2, 3}), kApart);
  add("sheets, the same but for a spike", sheet_in, joined(sheet_in, segment({4, 4, 4}, {4, 4, 8})), kTouching);
  add("sheets, the same but for a segment in one", sheet_in, joined(sheet_in, segment({3, 3, 4}, {5, 4, 4})),
      kDuplicate);
  return pairs;
}

std::vector<SolidPair> point_pairs() {
  const MeshData solid = box({0, 0, 0}, {8, 8, 8}), flat = sheet({2, 6}, {2, 6}, 4);
  return {{"a point in a solid", point({2, 3, 4}), solid, kInner, false},
          {"two points in a solid", joined(point({2, 3, 4}), point({5, 6, 7})), solid, kInner, false},
          {"points in and out of a solid", joined(point({2, 3, 4}), point({5, 6, 11})), solid, kCrossing, false},
          {"a point on a face", point({2, 3, 8}), solid, kTouching, false},
          {"a point on a corner", point({8, 8, 8}), solid, kTouching, false},
          {"a point above a face", point({2, 3, 8.5}), solid, kApart, false},
          {"a point on a sheet", point({3, 4, 4}), flat, kTouching, false},
          {"points, the same", point({3, 4, 4}), point({3, 4, 4}), kDuplicate, false}};
}

namespace {

/// `solid`: an oracle knows better. The verdicts are on a surface, which has nothing in it but is there in the middle.
void add_with_each(std::vector<SolidPair>& pairs, const std::string& name, const MeshData& part, bool solid) {
  const auto add = [&](const std::string& what, const MeshData& other, const Judgement& of_surface) {
    pairs.push_back({name + ": " + what, part, other, solid ? std::nullopt : std::optional(of_surface), solid});
  };
  add("a block in the middle", box({2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}), kApart);
  add("a block that fills the middle", box({2, 2, 2}, {4, 4, 4}), kTouching);
  add("a block that fills the middle, cut", block({2, 3, 4}, {2, 4}, {2, 4}), kTouching);
  add("a block from the middle to the first", box({1, 2.5, 2.5}, {3, 3.5, 3.5}), kCrossing);
  add("a block from the middle outwards", box({3, 3, 3}, {5, 5, 9}), kCrossing);
  add("a block in the first", box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), kApart);
  add("a block in the second", box({4.5, 4.5, 4.5}, {5.5, 5.5, 5.5}), kApart);
  add("a block on the first, in the corner of the second", box({4, 0, 0}, {6, 2, 2}), kTouching);
  add("a block in the corner, flush with both", box({4, 1, 2}, {5, 2, 3}), kTouching);
  add("a block across the corner", box({3, 1, 2}, {5, 3, 3}), kCrossing);
  add("a block around", box({-1, -1, -1}, {7, 7, 7}), kInner);
  add("a block around, flush", box({0, 0, 0}, {6, 6, 6}), kInner);
  add("the first", box({0, 0, 0}, {4, 4, 4}), kCrossing);
  add("the second", box({2, 2, 2}, {6, 6, 6}), kCrossing);
  const auto in_either = [](int x, int y, int z) { return std::max({x, y, z}) < 2 || std::min({x, y, z}) > 0; };
  add("the union", boundary({{0, 2, 4, 6}, {0, 2, 4, 6}, {0, 2, 4, 6}, in_either}), kInner);
  add("itself", part, kDuplicate);
}

}  // namespace

std::vector<SolidPair> self_passing_pairs() {
  std::vector<SolidPair> pairs;
  const std::vector<double> low{0, 2, 4}, high{2, 4, 6};
  const MeshData first = block(low, low, low), second = block(high, high, high);
  add_with_each(pairs, "cut alike", joined(first, second), true);
  add_with_each(pairs, "cut alike, the second inverted", joined(first, inverted(second)), true);
  add_with_each(pairs, "cut otherwise", joined(block(low, low, {0, 2, 3, 4}), second), false);
  add_with_each(pairs, "the first cut", joined(first, box({2, 2, 2}, {6, 6, 6})), false);
  return pairs;
}

std::vector<SolidPair> passing_pairs() {
  std::vector<SolidPair> pairs;
  add_lines(pairs);
  add_mixed(pairs);
  return pairs;
}

}  // namespace impinge::scenes
