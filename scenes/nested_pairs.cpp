// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

MeshData cube_from(double low, double high) { return box({low, low, low}, {high, high, high}); }
MeshData cut_cube(const std::vector<double>& at, std::uint64_t seed = 0) { return block(at, at, at, seed); }
/// The cube from 0 to 8 with a cubic cavity.
MeshData hollow(double low, double high) { return joined(cube_from(0, 8), inverted(cube_from(low, high))); }

Outline octagon(double s) {
  return {{2 * s, -s}, {2 * s, s}, {s, 2 * s}, {-s, 2 * s}, {-2 * s, s}, {-2 * s, -s}, {-s, -2 * s}, {s, -2 * s}};
}

}  // namespace

std::vector<SolidPair> nested_pairs() {
  const MeshData outer = cube_from(0, 8);
  const MeshData cut = cut_cube({0, 2, 6, 8}, 11);
  return {
      {"free", cube_from(2, 6), outer, kInner},
      {"free, the other way round", outer, cube_from(2, 6), kOuter},
      {"free, a thin wall away", cube_from(0.25, 7.75), outer, kInner},
      {"flush on one face", box({2, 2, 0}, {6, 6, 4}), outer, kInner},
      {"flush on one face, an edge on its edge", box({0, 2, 0}, {6, 6, 4}), outer, kInner},
      {"flush on one face, cut so that edges meet", block({2, 6}, {2, 6}, {0, 2, 4}, 12), cut, kInner},
      {"flush on three faces", cube_from(0, 4), outer, kInner},
      {"flush on three faces, other diagonals", cut_cube({0, 4}, 13), cut, kInner},
      {"flush on two opposite faces", box({2, 2, 0}, {6, 6, 8}), outer, kInner},
      {"flush on four faces", box({2, 0, 0}, {6, 8, 8}), outer, kInner},
      {"flush on four faces, cut alike", block({2, 6}, {0, 2, 6, 8}, {0, 2, 6, 8}, 14), cut, kInner},
      {"flush on five faces", box({0, 0, 0}, {6, 8, 8}), outer, kInner},
      {"a vertex on a face", hull({{2, 2, 4}, {6, 2, 4}, {4, 6, 4}, {4, 4, 8}}), outer, kInner},
      {"a vertex on a vertex", hull({{2, 2, 4}, {6, 2, 4}, {4, 6, 4}, {8, 8, 8}}), outer, kInner},
      {"a vertex on an edge", hull({{2, 2, 4}, {6, 2, 4}, {4, 6, 4}, {4, 8, 8}}), outer, kInner},
      {"an edge on a face", hull({{2, 2, 4}, {6, 2, 4}, {2, 6, 4}, {6, 6, 4}, {4, 2, 8}, {4, 6, 8}}), outer, kInner},
      {"an edge on an edge", hull({{2, 2, 4}, {6, 2, 4}, {8, 2, 8}, {8, 6, 8}, {4, 6, 4}}), outer, kInner},
      {"flush on three faces and out of the fourth", box({0, 0, 0}, {9, 4, 4}), outer, kPenetrating},
      {"one face flush, wider", box({-1, -1, 0}, {9, 9, 4}), outer, kPenetrating},
      {"in a notched block", box({1, 1, 1}, {3, 3, 7}),
       boundary({{0, 4, 8}, {0, 4, 8}, {0, 8}, [](int i, int j, int) { return i + j < 2; }}), kInner},
  };
}

std::vector<SolidPair> cavity_pairs() {
  const MeshData outer = hollow(2, 6);
  const MeshData cut = boundary({{0, 2, 4, 6, 8},
                                 {0, 2, 4, 6, 8},
                                 {0, 2, 4, 6, 8},
                                 [](int i, int j, int k) { return !(i % 3 != 0 && j % 3 != 0 && k % 3 != 0); }},
                                15);
  return {
      {"free in the cavity", cube_from(3, 5), outer, kApart},
      {"free in a cut cavity", cube_from(3, 5), cut, kApart},
      {"fills the cavity", cube_from(2, 6), outer, kTouching},
      {"fills the cavity, other diagonals", cut_cube({2, 6}, 16), outer, kTouching},
      {"fills the cavity, cut alike", cut_cube({2, 4, 6}, 17), cut, kTouching},
      {"fills the cavity, cut otherwise", cut_cube({2, 3, 6}, 18), cut, kTouching},
      {"stands in the cavity", box({3, 3, 2}, {5, 5, 4}), outer, kTouching},
      {"stands in the cavity's corner", cube_from(2, 4), outer, kTouching},
      {"stands in the cavity's corner, cut alike", cube_from(2, 4), cut, kTouching},
      {"a vertex on the cavity's wall", hull({{3, 3, 4}, {5, 3, 4}, {4, 5, 4}, {4, 4, 6}}), outer, kTouching},
      {"a vertex in the cavity's corner", hull({{3, 3, 4}, {5, 3, 4}, {4, 5, 4}, {6, 6, 6}}), outer, kTouching},
      {"an octahedron's vertices on all walls",
       hull({{2, 4, 4}, {6, 4, 4}, {4, 2, 4}, {4, 6, 4}, {4, 4, 2}, {4, 4, 6}}), cut, kTouching},
      {"through the cavity's wall", cube_from(1, 5), outer, kPenetrating},
      {"fills the cavity and more on one side", box({2, 2, 2}, {6, 6, 7}), outer, kPenetrating},
      {"fills the cavity and more on all sides", cube_from(1, 7), outer, kPenetrating},
      {"across the cavity from wall to wall", box({3, 3, 1}, {5, 5, 7}), outer, kPenetrating},
      {"from one wall of the cavity to the other", box({3, 3, 2}, {5, 5, 6}), outer, kTouching},
      {"in the wall", cube_from(0.5, 1.5), outer, kInner},
      {"in the wall, flush with the cavity", box({0.5, 3, 3}, {2, 5, 5}), outer, kInner},
      {"in the wall, from outside to the cavity", box({0, 3, 3}, {2, 5, 5}), outer, kInner},
      {"in the wall, at the cavity's corner", cube_from(0, 2), cut, kInner},
      {"the block without its cavity", outer, cube_from(0, 8), kInner},
      {"a larger block without a cavity", outer, cube_from(-1, 9), kInner},
      {"the same with a smaller cavity", outer, hollow(3, 5), kInner},
      {"the same with a cavity aside", outer, hollow(3, 7), kPenetrating},
      {"the same with a cavity that shares a wall", outer, joined(cube_from(0, 8), inverted(box({2, 2, 2}, {6, 6, 4}))),
       kInner},
      {"the same, cut", outer, cut, kDuplicate},
      {"hollow within hollow", joined(cube_from(3, 5), inverted(cube_from(3.5, 4.5))), outer, kApart},
      {"hollow within hollow, flush", joined(cube_from(2, 6), inverted(cube_from(3, 5))), outer, kTouching},
      {"hollow around, flush", joined(cube_from(-2, 10), inverted(cube_from(0, 8))), outer, kTouching},
      {"hollow around, its cavity the other's walls' middle", joined(cube_from(-2, 10), inverted(cube_from(1, 7))),
       outer, kPenetrating},
  };
}

std::vector<SolidPair> duplicate_pairs() {
  const MeshData cube4 = cube_from(0, 4);
  const MeshData far = shifted(cube4, 6, 0, 0);
  const std::vector<std::array<int, 3>> corners{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {1, 1, 4}, {3, 3, 4}};
  const auto bent = [&](double z) {
    MeshData mesh = hull(corners);
    for (std::size_t i = 2; i < mesh.xyz.size(); i += 3) {
      mesh.xyz[i] = mesh.xyz[i] == 4 && mesh.xyz[i - 1] == 3 ? z : mesh.xyz[i];
    }
    return mesh;
  };
  return {
      {"the same", cube4, cube4, kDuplicate},
      {"the same, inverted", cube4, inverted(cube4), kDuplicate},
      {"the same, no vertex shared", cube4, unshared(cube4), kDuplicate},
      {"the same, other diagonals", block({0, 4}, {0, 4}, {0, 4}, 21), block({0, 4}, {0, 4}, {0, 4}, 22), kDuplicate},
      {"the same, cut", cube4, cut_cube({0, 1, 4}), kDuplicate},
      {"the same, both cut", cut_cube({0, 1, 4}), cut_cube({0, 3, 4}, 23), kDuplicate},
      {"the same, cut in half at an edge", block({0, 2, 4}, {0, 4}, {0, 4}), block({0, 4}, {0, 2, 4}, {0, 4}),
       kDuplicate},
      {"the same hull, other fans", hull(corners), hull(corners, 1), kDuplicate},
      {"the same shells in another order", joined(cube4, far), joined(far, cube4), kDuplicate},
      {"the same shells, one inverted", joined(cube4, far), joined(inverted(far), cube4), kDuplicate},
      {"the same with a second shell within", cube4, joined(cube4, cube_from(1, 3)), kDuplicate},
      {"the same but for a corner, further in", bent(3.75), hull(corners), kInner},
      {"the same but for a corner, further out", bent(4.25), hull(corners), kOuter},
      {"the same, a little smaller", cube_from(0.125, 3.875), cube4, kInner},
      {"the same, a little aside", cube4, shifted(cube4, 0.25, 0, 0), kPenetrating},
      {"the same and a second shell", cube4, joined(cube4, far), kInner},
  };
}

std::vector<SolidPair> inverted_pairs() {
  std::vector<SolidPair> pairs;
  const auto add = [&](const std::string& name, const MeshData& a, const MeshData& b, const Judgement& known) {
    pairs.push_back({name + ", a inverted", inverted(a), b, known});
    pairs.push_back({name + ", b inverted", a, inverted(b), known});
    pairs.push_back({name + ", both inverted", inverted(a), inverted(b), known});
  };
  const MeshData cube4 = cube_from(0, 4);
  add("aligned overlap", cube4, box({2, 0, 0}, {6, 4, 4}), kPenetrating);
  add("flush faces", cube4, box({4, 1, 1}, {8, 3, 3}), kTouching);
  add("nested", cube_from(1, 3), cube4, kInner);
  add("nested and flush", box({1, 1, 0}, {3, 3, 2}), cube4, kInner);
  add("fills a cavity", cube_from(2, 6), hollow(2, 6), kTouching);
  add("in a cavity", cube_from(3, 5), hollow(2, 6), kApart);
  add("tetrahedra on one base", hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 4}}),
      hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {5, 5, 4}}), kPenetrating);
  return pairs;
}

std::vector<SolidPair> shell_pairs() {
  const MeshData one = cube_from(0, 4), two = shifted(one, 6, 0, 0), three = shifted(one, 0, 6, 0);
  const MeshData both = joined(one, two);
  const MeshData doubled = joined(cube_from(0, 8), cube_from(2, 6));  // wound around twice in the middle
  const MeshData island = joined(hollow(2, 6), cube_from(3, 5));
  const MeshData by_edge = joined(one, shifted(one, 4, 4, 0)), by_corner = joined(one, shifted(one, 4, 4, 4));
  return {
      {"one shell shared", both, joined(two, three), kPenetrating},
      {"one shell is the other part", both, two, kOuter},
      {"one shell inverted", joined(one, inverted(two)), two, kOuter},
      {"between the shells", both, box({4.5, 0, 0}, {5.5, 4, 4}), kApart},
      {"between the shells, flush on both", both, box({4, 0, 0}, {6, 4, 4}), kTouching},
      {"from shell to shell", both, box({3, 1, 1}, {7, 3, 3}), kPenetrating},
      {"in both shells", joined(cube_from(1, 3), shifted(cube_from(1, 3), 6, 0, 0)), both, kInner},
      {"in one shell, the other apart", joined(cube_from(1, 3), three), both, kPenetrating},
      {"in one shell, the other flush", joined(cube_from(1, 3), box({4, 0, 0}, {6, 4, 4})), both, kPenetrating},
      {"around both shells", both, box({-1, -1, -1}, {11, 5, 5}), kInner},
      {"doubled within: a part there", cube_from(3, 5), doubled, kInner},
      {"doubled within: a part across", cube_from(1, 5), doubled, kInner},
      {"doubled within: a part flush there", box({3, 3, 2}, {5, 5, 4}), doubled, kInner},
      {"doubled within: a part flush from beyond", box({3, 3, 0.5}, {5, 5, 2}), doubled, kInner},
      {"doubled within: the same", cube_from(2, 6), doubled, kInner},
      {"doubled within: flush outside", box({8, 0, 0}, {9, 8, 8}), doubled, kTouching},
      {"doubled within: out of it", box({4, 4, 4}, {9, 5, 5}), doubled, kPenetrating},
      {"doubled within: around", doubled, cube_from(-1, 9), kInner},
      {"doubled within: hollow there", doubled, hollow(2, 6), kOuter},
      {"doubled within: doubled elsewhere", doubled, joined(cube_from(0, 8), cube_from(1, 3)), kDuplicate},
      {"an island in a cavity: in the island", cube_from(3.5, 4.5), island, kInner},
      {"an island in a cavity: the island", cube_from(3, 5), island, kInner},
      {"an island in a cavity: between", box({2.25, 2.25, 2.25}, {2.75, 5.5, 5.5}), island, kApart},
      {"an island in a cavity: between, flush", box({2, 3, 3}, {3, 5, 5}), island, kTouching},
      {"an island in a cavity: across", box({2.5, 3.5, 3.5}, {5.5, 4.5, 4.5}), island, kPenetrating},
      {"an island in a cavity: without it", island, hollow(2, 6), kOuter},
      {"shells edge to edge: in the gap", by_edge, box({4, 0, 0}, {8, 4, 4}), kTouching},
      {"shells edge to edge: across the edge", by_edge, box({3, 3, 1}, {5, 5, 3}), kPenetrating},
      {"shells corner to corner: across the corner", by_corner, cube_from(3, 5), kPenetrating},
      {"shells corner to corner: at the corner", by_corner, box({4, 0, 0}, {8, 4, 4}), kTouching},
      {"shells corner to corner: around", by_corner, cube_from(0, 8), kInner},
  };
}

std::vector<SolidPair> concave_pairs() {
  const MeshData ell = boundary({{0, 4, 8}, {0, 4, 8}, {0, 4}, [](int i, int j, int) { return i + j < 2; }});
  const MeshData u = boundary({{0, 2, 6, 8}, {0, 2, 8}, {0, 4}, [](int i, int j, int) { return i != 1 || j == 0; }});
  const MeshData link =
      boundary({{0, 2, 6, 8}, {0, 2, 6, 8}, {0, 2}, [](int i, int j, int) { return i != 1 || j != 1; }});
  const MeshData bolt = boundary(
      {{0, 2, 6, 8}, {0, 2, 6, 8}, {0, 4, 6}, [](int i, int j, int k) { return k == 1 || (i == 1 && j == 1); }});
  const MeshData tube = ring(octagon(4), octagon(2), 0, 8);
  return {
      {"in the L's notch", ell, box({4, 4, 0}, {8, 8, 4}), kTouching},
      {"in the L's notch, smaller", ell, box({4, 4, 1}, {6, 6, 3}), kTouching},
      {"in the L's notch, longer", ell, box({4, 4, -1}, {9, 9, 5}), kTouching},
      {"in the L's notch, not touching", ell, box({5, 5, 0}, {8, 8, 4}), kApart},
      {"in the L's notch, on its edge alone", ell,
       hull({{4, 4, 1}, {4, 4, 3}, {6, 7, 1}, {6, 7, 3}, {7, 6, 1}, {7, 6, 3}}), kTouching},
      {"in the L's notch and into it", ell, box({3, 4, 0}, {8, 8, 4}), kPenetrating},
      {"the L's hull", ell, box({0, 0, 0}, {8, 8, 4}), kInner},
      {"an L with an L in its notch", ell,
       boundary({{0, 4, 8}, {0, 4, 8}, {4, 8}, [](int i, int j, int) { return i + j > 0; }}), kTouching},
      {"two Ls that make a block", ell, box({4, 4, 0}, {8, 8, 8}), kTouching},
      {"a tongue in the U", u, box({2, 2, 0}, {6, 8, 4}), kTouching},
      {"a tongue in the U, longer", u, box({2, 3, -2}, {6, 12, 6}), kTouching},
      {"a tongue in the U, looser", u, box({3, 3, 0}, {5, 8, 4}), kApart},
      {"a tongue in the U, tighter", u, box({1.5, 3, 1}, {6.5, 8, 3}), kPenetrating},
      {"a tongue in the U, on one side", u, box({2, 3, 0}, {5, 8, 4}), kTouching},
      {"a bar across the U", u, box({-1, 4, 1}, {9, 6, 3}), kPenetrating},
      {"a bar across the U, flush", u, box({-1, 4, 4}, {9, 6, 6}), kTouching},
      {"links of a chain, not touching", link, shifted(turned(link), 3, 3, -3), kApart},
      {"links of a chain, flush", link, shifted(turned(link), 3, 4, -3), kTouching},
      {"links of a chain, flush in a corner", link, shifted(turned(link), 3, 4, -2), kTouching},
      {"links of a chain, flush on both sides", link, shifted(turned(link), 3, 2, -3), kTouching},
      {"links of a chain, grown together", link, shifted(turned(link), 3, 1, -3), kPenetrating},
      {"a bolt in a plate", bolt,
       boundary({{-2, 2, 6, 10}, {-2, 2, 6, 10}, {1, 4}, [](int i, int j, int) { return i != 1 || j != 1; }}),
       kTouching},
      {"a bolt in too thick a plate", bolt,
       boundary({{-2, 2, 6, 10}, {-2, 2, 6, 10}, {1, 4.5}, [](int i, int j, int) { return i != 1 || j != 1; }}),
       kPenetrating},
      {"a bolt in too wide a hole, resting", bolt,
       boundary({{-2, 1, 7, 10}, {-2, 1, 7, 10}, {1, 4}, [](int i, int j, int) { return i != 1 || j != 1; }}),
       kTouching},
      {"a rod in a tube, flush", tube, prism(octagon(2), -2, 10), kTouching},
      {"a rod in a tube, flush with its ends", tube, prism(octagon(2), 0, 8), kTouching},
      {"a rod in a tube, loose", tube, prism(octagon(1), -2, 10), kApart},
      {"a rod in a tube, tight", tube, prism(octagon(2.25), -2, 10), kPenetrating},
      {"a rod in a tube, tight and short", tube, prism(octagon(2.25), 2, 4), kPenetrating},
      {"a square rod in a tube, on its edges", tube, prism({{4, 2}, {-2, 4}, {-4, -2}, {2, -4}}, -2, 10), kTouching},
      {"a square rod in a tube, through its wall", tube, prism({{8, 4}, {-4, 8}, {-8, -4}, {4, -8}}, -2, 10),
       kPenetrating},
      {"a tube in a tube, flush", tube, ring(octagon(6), octagon(4), 2, 10), kTouching},
      {"tubes end to end", tube, ring(octagon(4), octagon(2), 8, 10), kTouching},
      {"tubes end to end, one wider", tube, ring(octagon(3), octagon(2.5), 8, 10), kTouching},
      {"a tube in a block", tube, box({-9, -9, -1}, {9, 9, 9}), kInner},
      {"a tube and its rod's hull", tube, prism(octagon(4), 0, 8), kInner},
      {"a rod in a tube's wall", box({5, -1, 0}, {7, 1, 8}), tube, kInner},
      {"a torus around a rod, not touching", ring(octagon(3), octagon(2), 3, 5), prism(octagon(1.5), 0, 8), kApart},
      {"a torus on a rod, at an angle", ring(octagon(3), octagon(1), 3, 5), turned(prism(octagon(0.5), -8, 8)), kApart},
      {"a torus cut by a rod", ring(octagon(3), octagon(1), -1, 1), turned(prism(octagon(0.25), -8, 8)), kPenetrating},
  };
}

std::vector<SolidPair> thin_pairs() {
  const MeshData plate = box({0, 0, 0}, {8, 8, 0.5});
  return {
      {"plates that overlap by a fifth", plate, box({0, 0, 0.4}, {8, 8, 0.9}), kPenetrating},
      {"plates that overlap by a fifth, aside", plate, box({3, 3, 0.4}, {11, 11, 0.9}), kPenetrating},
      {"plates that overlap by a fifth at a side", plate, box({7.9, 0, 0}, {15.9, 8, 0.5}), kPenetrating},
      {"plates flush", plate, box({0, 0, 0.5}, {8, 8, 1}), kTouching},
      {"plates flush, aside", plate, box({3, 3, 0.5}, {11, 11, 1}), kTouching},
      {"plates flush, a fine one", plate, shifted(box({0, 0, 0}, {8, 8, 0.5}, 4), 1, 1, 0.5), kTouching},
      {"plates a fifth apart", plate, box({0, 0, 0.6}, {8, 8, 1.1}), kApart},
      {"plates across", plate, box({4, 0, -4}, {4.5, 8, 4}), kPenetrating},
      {"plates across, one on the other", plate, box({4, 0, 0.5}, {4.5, 8, 4}), kTouching},
      {"a plate in a block, flush with its bottom", plate, box({-1, -1, 0}, {9, 9, 4}), kInner},
      {"a plate in the middle of another", box({1, 1, 0.125}, {7, 7, 0.375}), plate, kInner},
      {"a needle through a plate", plate, box({4, 4, -4}, {4.125, 4.125, 4}), kPenetrating},
      {"a needle on a plate", plate, box({4, 4, 0.5}, {4.125, 4.125, 4}), kTouching},
      {"wedges along their thin edges", hull({{0, 0, 0}, {0, 8, 0}, {8, 0, 0}, {8, 8, 0}, {8, 0, 1}, {8, 8, 1}}),
       hull({{0, 0, 0}, {0, 8, 0}, {-8, 0, 0}, {-8, 8, 0}, {-8, 0, 1}, {-8, 8, 1}}), kTouching},
      {"wedges with a common thin edge, one on the other",
       hull({{0, 0, 0}, {0, 8, 0}, {8, 0, 0}, {8, 8, 0}, {8, 0, 1}, {8, 8, 1}}),
       hull({{0, 0, 0}, {0, 8, 0}, {8, 0, 1}, {8, 8, 1}, {8, 0, 2}, {8, 8, 2}}), kTouching},
  };
}

}  // namespace impinge::scenes
