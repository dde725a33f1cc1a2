// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

MeshData cube_from(double low, double high) { return box({low, low, low}, {high, high, high}); }
MeshData upright(const std::vector<double>& y, const std::vector<double>& z, double x, std::uint64_t seed = 0) {
  return turned(turned(turned(turned(sheet(y, z, x, seed)))));
}

void add_with_solids(std::vector<SolidPair>& pairs) {
  const MeshData solid = cube_from(0, 8);
  const MeshData hollow = joined(solid, inverted(cube_from(2, 6)));
  const std::vector<double> across{-2, 0, 8, 10};
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name, a, b, known, false});
  };
  add("a sheet in a solid", sheet({2, 6}, {2, 6}, 4), solid, kInner);
  add("a sheet in a solid, the other way round", solid, sheet({2, 6}, {2, 6}, 4), kOuter);
  add("a sheet in a solid, from wall to wall", sheet({0, 8}, {0, 8}, 4), solid, kInner);
  add("a sheet in a solid, from edge to edge", sheet({0, 8}, {0, 8}, 4), block({0, 8}, {0, 8}, {0, 4, 8}), kInner);
  add("a sheet in a solid, an edge on a face", upright({2, 6}, {4, 8}, 4), solid, kInner);
  add("a sheet in a solid's wall", sheet({2, 6}, {2, 6}, 1), hollow, kInner);
  add("a sheet through a solid", sheet({-2, 10}, {-2, 10}, 4), solid, kCrossing);
  add("a sheet through a solid, cut where they meet", sheet(across, across, 4), block({0, 8}, {0, 8}, {0, 4, 8}),
      kCrossing);
  add("a sheet through a solid, cut where they meet, other diagonals", sheet(across, across, 4, 31),
      block({0, 8}, {0, 8}, {0, 4, 8}, 32), kCrossing);
  add("a sheet half in a solid", sheet({4, 10}, {2, 6}, 4), solid, kCrossing);
  add("a sheet half in a solid, cut where it goes in", sheet({4, 8, 10}, {2, 6}, 4), solid, kCrossing);
  add("a sheet in a solid and its cavity", sheet({1, 4}, {3, 5}, 4), hollow, kCrossing);
  add("a sheet on a face", sheet({2, 6}, {2, 6}, 8), solid, kTouching);
  add("a sheet on a face, inverted", inverted(sheet({2, 6}, {2, 6}, 8)), solid, kTouching);
  add("a sheet on the whole of a face", sheet({0, 8}, {0, 8}, 8), solid, kTouching);
  add("a sheet on the whole of a face, other diagonals", sheet({0, 4, 8}, {0, 8}, 8, 33), solid, kTouching);
  add("a sheet on a face and beyond", sheet(across, across, 8), solid, kTouching);
  add("a sheet half on a face", sheet({4, 10}, {2, 6}, 8), solid, kTouching);
  add("a sheet that fills the cavity's mouth", sheet({2, 6}, {2, 6}, 2), hollow, kTouching);
  add("a sheet across the cavity", sheet({2, 6}, {2, 6}, 4), hollow, kTouching);
  add("a sheet free in the cavity", sheet({3, 5}, {3, 5}, 4), hollow, kApart);
  add("a sheet edge on a face", upright({2, 6}, {8, 10}, 4), solid, kTouching);
  add("a sheet edge on an edge", upright({2, 6}, {8, 10}, 8), solid, kTouching);
  add("a sheet's corner on a face", opened(shifted(hull({{0, 0, 0}, {4, 0, 4}, {0, 4, 4}, {1, 1, 4}}), 2, 2, 8), 1),
      solid, kTouching);
  add("a sheet's corner on a corner", sheet({8, 10}, {8, 10}, 8), solid, kTouching);
  add("a sheet above a face", sheet({2, 6}, {2, 6}, 8.5), solid, kApart);
  add("the solid without its top", opened(solid), solid, kTouching);
  add("an open box, a block free in it", opened(solid), cube_from(2, 6), kApart);
  add("an open box, a block standing in it", opened(solid), box({2, 2, 0}, {6, 6, 4}), kTouching);
  add("an open box, a block that fills it", opened(block({0, 8}, {0, 8}, {0, 8}, 34)), solid, kTouching);
  add("an open box, a block through its wall", opened(solid), box({6, 2, 2}, {10, 4, 4}), kCrossing);
  add("an open box, a block through its mouth", opened(solid), box({2, 2, 4}, {6, 6, 12}), kApart);
  add("an open box in a block", opened(cube_from(2, 6)), solid, kInner);
}

void add_without_solids(std::vector<SolidPair>& pairs) {
  const MeshData flat = sheet({0, 8}, {0, 8}, 0);
  const MeshData crossed = joined(cube_from(0, 4), cube_from(2, 6));  // closed, and crosses itself
  const MeshData stacked = joined(box({0, 0, 0}, {4, 4, 4}), shifted(box({0, 0, 0}, {4, 4, 4}), 4, 0, 0));
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name, a, b, known, false});
  };
  add("sheets that cross", flat, upright({2, 6}, {-2, 2}, 3), kCrossing);
  add("sheets that cross, wide", flat, upright({-2, 10}, {-2, 2}, 3), kCrossing);
  add("sheets edge on face", flat, upright({2, 6}, {0, 4}, 3), kTouching);
  add("sheets edge on edge", flat, upright({2, 6}, {0, 4}, 8), kTouching);
  add("sheets corner on face", flat, shifted(opened(hull({{0, 0, 0}, {2, 0, 2}, {0, 2, 2}, {1, 1, 3}}), 1), 3, 4, 0),
      kTouching);
  add("sheets side by side", flat, sheet({8, 16}, {0, 8}, 0), kTouching);
  add("sheets side by side, a part", flat, sheet({8, 16}, {4, 12}, 0), kTouching);
  add("sheets corner to corner", flat, sheet({8, 16}, {8, 16}, 0), kTouching);
  add("sheets one on the other, a part", flat, sheet({4, 12}, {4, 12}, 0), kTouching);
  add("sheets one on the other, within", flat, sheet({2, 6}, {2, 6}, 0), kTouching);
  add("sheets, the same", flat, flat, kDuplicate);
  add("sheets, the same, inverted", flat, inverted(flat), kDuplicate);
  add("sheets, the same, other diagonals", sheet({0, 8}, {0, 8}, 0, 35), sheet({0, 8}, {0, 8}, 0, 37), kTouching);
  add("sheets, the same, cut", flat, sheet({0, 3, 8}, {0, 5, 8}, 0, 36), kTouching);
  add("sheets, the same but for a corner", flat, opened(sheet({0, 7, 8}, {0, 7, 8}, 0)), kTouching);
  add("sheets a little apart", flat, sheet({0, 8}, {0, 8}, 0.25), kApart);
  add("open boxes, the same", opened(cube_from(0, 8)), opened(block({0, 4, 8}, {0, 8}, {0, 8}, 38), 4), kTouching);
  add("open boxes, nested and free", opened(cube_from(0, 8)), opened(cube_from(2, 6)), kApart);
  add("open boxes that cross", opened(cube_from(0, 8)), opened(cube_from(4, 12)), kCrossing);
  add("crosses itself: a block in it", crossed, cube_from(0.5, 1.5), kOuter);
  add("crosses itself: in a block", crossed, cube_from(-1, 7), kInner);
  add("crosses itself: in a block, flush", crossed, cube_from(0, 6), kInner);
  add("crosses itself: through a block", crossed, box({-1, 0.5, 0.5}, {1, 1.5, 1.5}), kPenetrating);
  add("crosses itself: on a block", crossed, box({-2, 0, 0}, {0, 4, 4}), kTouching);
  add("crosses itself: the same", crossed, joined(cube_from(2, 6), cube_from(0, 4)), kDuplicate);
  add("crosses itself: a block through a block, aside", crossed, box({8, 0, 0}, {9, 1, 1}), kApart);
  add("shares an area with itself: the same", stacked, stacked, kDuplicate);
  add("shares an area with itself: in a block", stacked, box({-1, -1, -1}, {9, 5, 5}), kInner);
  add("shares an area with itself: on a block", stacked, box({0, 0, -4}, {8, 4, 0}), kTouching);
}

}  // namespace

std::vector<SolidPair> surface_pairs() {
  std::vector<SolidPair> pairs;
  add_with_solids(pairs);
  add_without_solids(pairs);
  return pairs;
}

}  // namespace impinge::scenes
