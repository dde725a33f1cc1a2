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

MeshData triangles(std::vector<double> xyz, std::vector<std::uint32_t> corners) {
  MeshData mesh;
  mesh.xyz = std::move(xyz), mesh.triangles = std::move(corners);
  return mesh;
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
  add("segments, the same", segment({2, 2, 2}, {6, 5, 4}), segment({6, 5, 4}, {2, 2, 2}), kTouching);
  add("segments, the same, cut", segment({2, 2, 2}, {6, 6, 4}),
      joined(segment({2, 2, 2}, {5, 5, 3.5}), segment({4, 4, 3}, {6, 6, 4})), kTouching);
  add("segments, one on the other", segment({2, 2, 2}, {6, 6, 4}), segment({4, 4, 3}, {6, 6, 4}), kTouching);
  add("segments that cross", segment({2, 2, 2}, {6, 6, 2}), segment({2, 6, 2}, {6, 2, 2}), kTouching);
  add("segments apart", segment({2, 2, 2}, {6, 6, 2}), segment({2, 6, 3}, {6, 2, 3}), kApart);
  add("sheets, the same but for a spike", sheet_in, joined(sheet_in, segment({4, 4, 4}, {4, 4, 8})), kTouching);
  add("sheets, the same but for a segment in one", sheet_in, joined(sheet_in, segment({3, 3, 4}, {5, 4, 4})),
      kTouching);
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

/// With a part of two cubes that pass through each other. `wound_twice`: the middle is, and so within; an oracle knows
/// better otherwise.
void add_with_each(std::vector<SolidPair>& pairs, const std::string& name, const MeshData& part, bool wound_twice) {
  const auto add = [&](const std::string& what, const MeshData& other, const Judgement& known) {
    pairs.push_back({name + ": " + what, part, other, wound_twice ? std::optional(known) : std::nullopt});
  };
  add("a block in the middle", box({2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}), kOuter);
  add("a block that fills the middle", box({2, 2, 2}, {4, 4, 4}), kOuter);
  add("a block that fills the middle, cut", block({2, 3, 4}, {2, 4}, {2, 4}), kOuter);
  add("a block from the middle to the first", box({1, 2.5, 2.5}, {3, 3.5, 3.5}), kOuter);
  add("a block from the middle outwards", box({3, 3, 3}, {5, 5, 9}), kPenetrating);
  add("a block in the first", box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), kOuter);
  add("a block in the second", box({4.5, 4.5, 4.5}, {5.5, 5.5, 5.5}), kOuter);
  add("a block on the first, in the corner of the second", box({4, 0, 0}, {6, 2, 2}), kTouching);
  add("a block in the corner, flush with both", box({4, 1, 2}, {5, 2, 3}), kTouching);
  add("a block across the corner", box({3, 1, 2}, {5, 3, 3}), kPenetrating);
  add("a block around", box({-1, -1, -1}, {7, 7, 7}), kInner);
  add("a block around, flush", box({0, 0, 0}, {6, 6, 6}), kInner);
  add("the first", box({0, 0, 0}, {4, 4, 4}), kOuter);
  add("the second", box({2, 2, 2}, {6, 6, 6}), kOuter);
  const auto in_either = [](int x, int y, int z) { return std::max({x, y, z}) < 2 || std::min({x, y, z}) > 0; };
  add("the union", boundary({{0, 2, 4, 6}, {0, 2, 4, 6}, {0, 2, 4, 6}, in_either}), kDuplicate);
  add("itself", part, kDuplicate);
}

}  // namespace

std::vector<SolidPair> self_passing_pairs() {
  std::vector<SolidPair> pairs;
  const std::vector<double> low{0, 2, 4}, high{2, 4, 6};
  const MeshData first = block(low, low, low), second = block(high, high, high);
  add_with_each(pairs, "cut alike", joined(first, second), true);
  add_with_each(pairs, "cut alike, the second inverted", joined(first, inverted(second)), false);
  add_with_each(pairs, "cut otherwise", joined(block(low, low, {0, 2, 3, 4}), second), true);
  add_with_each(pairs, "the first cut", joined(first, box({2, 2, 2}, {6, 6, 6})), true);
  return pairs;
}

}  // namespace impinge::scenes
