// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "scenes/shapes.hpp"
#include "scenes/solid_pairs.hpp"
#include "scenes/solids.hpp"

namespace impinge::scenes {
namespace {

/// A ridge along x at z = 0, from -4 to 4, on a house below.
MeshData roof() { return hull({{-4, -4, -4}, {-4, 4, -4}, {4, -4, -4}, {4, 4, -4}, {-4, 0, 0}, {4, 0, 0}}); }
/// The same upside down; and across, its ridge along y.
MeshData keel() { return hull({{-4, -4, 4}, {-4, 4, 4}, {4, -4, 4}, {4, 4, 4}, {-4, 0, 0}, {4, 0, 0}}); }
MeshData keel_across() { return hull({{-4, -4, 4}, {-4, 4, 4}, {4, -4, 4}, {4, 4, 4}, {0, -4, 0}, {0, 4, 0}}); }
/// A point at the origin, below and above its base.
MeshData spike_down() { return hull({{-3, -3, 4}, {-3, 3, 4}, {3, -3, 4}, {3, 3, 4}, {0, 0, 0}}); }
MeshData spike_up() { return hull({{-3, -3, -4}, {-3, 3, -4}, {3, -3, -4}, {3, 3, -4}, {0, 0, 0}}); }

/// As b touches a from above, and moved a little down and up.
void add_contact(std::vector<SolidPair>& pairs, const std::string& name, const MeshData& a, const MeshData& b) {
  pairs.push_back({name, a, b, kTouching});
  pairs.push_back({name + ", deeper", a, shifted(b, 0, 0, -0.25), kPenetrating});
  pairs.push_back({name + ", apart", a, shifted(b, 0, 0, 0.25), kApart});
}

/// The dodecahedron with integer corners (a pyritohedron).
std::vector<std::array<int, 3>> dodecahedron() {
  std::vector<std::array<int, 3>> corners;
  for (const int u : {-1, 1}) {
    for (const int v : {-1, 1}) {
      corners.push_back({0, 6 * u, 3 * v});
      corners.push_back({3 * v, 0, 6 * u});
      corners.push_back({6 * u, 3 * v, 0});
      corners.push_back({4 * u, 4 * v, 4});
      corners.push_back({4 * u, 4 * v, -4});
    }
  }
  return corners;
}

}  // namespace

std::vector<SolidPair> overlapping_pairs() {
  const MeshData cube4 = box({0, 0, 0}, {4, 4, 4});
  const MeshData corner = hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}});
  const MeshData on_base = hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 4}});
  const Outline square{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  const auto diamond = [](double r) { return Outline{{r, 0}, {0, r}, {-r, 0}, {0, -r}}; };
  return {
      {"boxes, no plane shared", cube4, box({2, 1, 1}, {6, 5, 5}), kPenetrating},
      {"boxes, one plane shared", cube4, box({2, 1, 0}, {6, 5, 3}), kPenetrating},
      {"boxes, two planes shared", cube4, box({2, 0, 0}, {6, 3, 3}), kPenetrating},
      {"boxes, three planes shared", cube4, box({2, 0, 0}, {6, 4, 3}), kPenetrating},
      {"boxes, four planes shared", cube4, box({2, 0, 0}, {6, 4, 4}), kPenetrating},
      {"boxes, four planes shared, cut alike", block({0, 2, 4}, {0, 4}, {0, 4}), block({2, 4, 6}, {0, 4}, {0, 4}),
       kPenetrating},
      {"boxes, four planes shared, cut alike, other diagonals", block({0, 2, 4}, {0, 4}, {0, 4}, 3),
       block({2, 4, 6}, {0, 4}, {0, 4}, 4), kPenetrating},
      {"boxes, four planes shared, overlap of an eighth", cube4, box({3.5, 0, 0}, {7.5, 4, 4}), kPenetrating},
      {"bars across, two planes shared", box({0, 2, 0}, {6, 4, 2}), box({2, 0, 0}, {4, 6, 2}), kPenetrating},
      {"bars across, two planes shared, cut alike", block({0, 2, 4, 6}, {2, 4}, {0, 2}),
       block({2, 4}, {0, 2, 4, 6}, {0, 2}), kPenetrating},
      {"bars across, no plane shared", box({0, 2, 2}, {6, 4, 4}), box({2, 0, 1}, {4, 6, 5}), kPenetrating},
      {"three bars' worth of edges, cut alike", block({0, 2, 4, 6}, {2, 4}, {2, 4}),
       block({2, 4}, {2, 4}, {0, 2, 4, 6}), kPenetrating},
      {"corners with three shared planes", corner, hull({{0, 0, 0}, {6, 0, 0}, {0, 2, 0}, {0, 0, 2}}), kPenetrating},
      {"a cube in a corner", box({0, 0, 0}, {1, 1, 1}), corner, kInner},
      {"a corner in a cube", corner, cube4, kInner},
      {"tetrahedra on one base, one side", on_base, hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {5, 5, 4}}), kPenetrating},
      {"tetrahedra on one base, one in the other", hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 2}}), on_base, kInner},
      {"tetrahedra on one base, two sides", on_base, hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -4}}), kTouching},
      {"tetrahedra on one base, one side, the other's on a part of it", on_base,
       hull({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-2, -2, 4}}), kPenetrating},
      {"a star of two squares", prism(square, 0, 4), prism(diamond(3), 0, 4), kPenetrating},
      {"a square in a diamond, corners on sides", prism(square, 0, 4), prism(diamond(4), 0, 4), kInner},
      {"a diamond in a square, corners on sides", prism(square, 0, 4), prism(diamond(2), 0, 4), kOuter},
      {"a square in a diamond, ends apart", prism(square, 0, 4), prism(diamond(4), 1, 5), kPenetrating},
      {"stella octangula", hull({{4, 4, 4}, {4, -4, -4}, {-4, 4, -4}, {-4, -4, 4}}),
       hull({{-4, -4, -4}, {-4, 4, 4}, {4, -4, 4}, {4, 4, -4}}), kPenetrating},
      {"edges through edges alone", prism(square, -1, 1), turned(prism(square, -1, 1)), kPenetrating},
  };
}

std::vector<SolidPair> flush_pairs() {
  const MeshData cube4 = box({0, 0, 0}, {4, 4, 4});
  const Outline hexagon{{2, 0}, {4, 0}, {6, 2}, {4, 4}, {2, 4}, {0, 2}};
  return {
      {"equal faces", cube4, box({4, 0, 0}, {8, 4, 4}), kTouching},
      {"equal faces, other diagonals", block({0, 4}, {0, 4}, {0, 4}, 1), block({4, 8}, {0, 4}, {0, 4}, 2), kTouching},
      {"equal faces, opposite diagonals", cube4, turned(turned(block({0, 4}, {0, 4}, {4, 8}, 5))), kTouching},
      {"faces that share a half", cube4, box({4, 2, 0}, {8, 6, 4}), kTouching},
      {"faces that share a quarter", cube4, box({4, 2, 2}, {8, 6, 6}), kTouching},
      {"a face within the other", cube4, box({4, 1, 1}, {8, 3, 3}), kTouching},
      {"a face within the other, an edge on its edge", cube4, box({4, 0, 1}, {8, 3, 3}), kTouching},
      {"a face within the other, a corner on its corner", cube4, box({4, 0, 0}, {8, 3, 3}), kTouching},
      {"a face cut so that edges meet", cube4, block({4, 8}, {0, 1, 4}, {0, 2, 4}), kTouching},
      {"both faces cut so that edges cross", block({0, 4}, {0, 1, 4}, {0, 1, 4}), block({4, 8}, {0, 3, 4}, {0, 3, 4}),
       kTouching},
      {"a cut face, its middle within the other", block({0, 4}, {0, 1, 3, 4}, {0, 1, 3, 4}), box({4, 1, 1}, {8, 3, 3}),
       kTouching},
      {"a face in quarters on a face", box({0, 0, 0}, {4, 4, 4}, 4), box({4, 0, 0}, {8, 4, 4}), kTouching},
      {"a fine face on a fine face, half a cell aside", box({0, 0, 0}, {4, 4, 4}, 4),
       box({4, 0.5, 0.5}, {8, 4.5, 4.5}, 4), kTouching},
      {"hexagons end to end", prism(hexagon, 0, 2), prism(hexagon, 2, 4), kTouching},
      {"a hexagon on a square", prism(hexagon, 0, 2), box({0, 0, 2}, {4, 4, 4}), kTouching},
      {"hexagons end to end, one aside", prism(hexagon, 0, 2), shifted(prism(hexagon, 2, 4), 3, 1, 0), kTouching},
      {"slanted faces", hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}),
       hull({{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}}), kTouching},
      {"slanted faces, one larger", hull({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}),
       hull({{4, -2, 0}, {0, 4, -2}, {-2, 0, 4}, {4, 4, 4}}), kTouching},
      {"flush, an eighth deeper", cube4, box({3.5, 1, 1}, {7.5, 3, 3}), kPenetrating},
      {"flush, an eighth apart", cube4, box({4.5, 1, 1}, {8.5, 3, 3}), kApart},
  };
}

std::vector<SolidPair> edge_and_vertex_pairs() {
  const MeshData floor = box({-5, -5, -4}, {5, 5, 0});
  const MeshData cut_floor = block({-5, 0, 5}, {-5, 0, 5}, {-4, 0}, 6);
  std::vector<SolidPair> pairs;
  add_contact(pairs, "edges that cross", roof(), keel_across());
  add_contact(pairs, "edges that cross at an end", roof(), shifted(keel_across(), 0, 4, 0));
  add_contact(pairs, "edges that meet at their ends", roof(), shifted(keel_across(), 4, 4, 0));
  add_contact(pairs, "equal edges", roof(), keel());
  add_contact(pairs, "edges that share a half", roof(), shifted(keel(), 4, 0, 0));
  add_contact(pairs, "an edge within an edge", roof(), scaled(keel(), 0.5, 1, 1));
  add_contact(pairs, "an edge on a face", floor, keel());
  add_contact(pairs, "an edge on a face, and beyond", box({-2, -2, -4}, {2, 2, 0}), keel());
  add_contact(pairs, "an edge on a face, along an edge that cuts it", cut_floor, keel());
  add_contact(pairs, "an edge on a face, along its diagonal", floor,
              hull({{-3, -3, 0}, {3, 3, 0}, {-5, 5, 4}, {5, -5, 4}}));
  add_contact(pairs, "an edge on a face, along its side", floor, shifted(keel(), 0, 5, 0));
  add_contact(pairs, "a vertex on a face", floor, shifted(spike_down(), 1, 2, 0));
  add_contact(pairs, "a vertex on a face's diagonal", floor, spike_down());
  add_contact(pairs, "a vertex on a vertex within a face", cut_floor, spike_down());
  add_contact(pairs, "a vertex on an edge within a face", cut_floor, shifted(spike_down(), 2, 0, 0));
  add_contact(pairs, "a vertex on a face's side", floor, shifted(spike_down(), 5, 1, 0));
  add_contact(pairs, "a vertex on a face's corner", floor, shifted(spike_down(), 5, 5, 0));
  add_contact(pairs, "a vertex on an edge", roof(), spike_down());
  add_contact(pairs, "a vertex on an edge's end", roof(), shifted(spike_down(), 4, 0, 0));
  add_contact(pairs, "a vertex on a vertex", spike_up(), spike_down());
  pairs.push_back({"boxes edge to edge", box({0, 0, 0}, {2, 2, 2}), box({2, 2, 0}, {4, 4, 2}), kTouching});
  pairs.push_back({"boxes along a part of an edge", box({0, 0, 0}, {2, 2, 2}), box({2, 2, 1}, {4, 4, 3}), kTouching});
  pairs.push_back({"boxes corner to corner", box({0, 0, 0}, {2, 2, 2}), box({2, 2, 2}, {4, 4, 4}), kTouching});
  pairs.push_back({"a vertex on a slanted face", hull({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}}),
                   box({2, 2, 2}, {4, 4, 4}), kTouching});
  pairs.push_back({"a vertex through a slanted face", hull({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}}),
                   box({1.75, 1.75, 1.75}, {4, 4, 4}), kPenetrating});
  return pairs;
}

std::vector<SolidPair> inscribed_pairs() {
  const std::vector<std::array<int, 3>> one{{4, 4, 4}, {4, -4, -4}, {-4, 4, -4}, {-4, -4, 4}};
  const MeshData tetrahedron = hull(one);
  const MeshData around = hull(dodecahedron());
  const MeshData octahedron = hull({{4, 0, 0}, {-4, 0, 0}, {0, 4, 0}, {0, -4, 0}, {0, 0, 4}, {0, 0, -4}});
  const MeshData cube8 = box({-4, -4, -4}, {4, 4, 4});
  const MeshData cavity = joined(box({-8, -8, -8}, {8, 8, 8}), inverted(around));
  return {
      {"a tetrahedron in a dodecahedron", tetrahedron, around, kInner},
      {"a tetrahedron in a dodecahedron, other fans", tetrahedron, hull(dodecahedron(), 2), kInner},
      {"a tetrahedron in a dodecahedron, aside", shifted(tetrahedron, 0.25, 0, 0), around, kPenetrating},
      {"a tetrahedron in a dodecahedron, smaller", scaled(tetrahedron, 0.75, 0.75, 0.75), around, kInner},
      {"a tetrahedron with one vertex out of a dodecahedron", hull({{5, 5, 5}, one[1], one[2], one[3]}), around,
       kPenetrating},
      {"a tetrahedron in a dodecahedral cavity", tetrahedron, cavity, kTouching},
      {"a tetrahedron in a dodecahedral cavity, aside", shifted(tetrahedron, 0.25, 0, 0), cavity, kPenetrating},
      {"a tetrahedron in a dodecahedral cavity, smaller", scaled(tetrahedron, 0.75, 0.75, 0.75), cavity, kApart},
      {"a dodecahedron in its cavity", around, cavity, kTouching},
      {"a tetrahedron at a dodecahedron's vertex", hull({{4, 4, 4}, {8, 8, 5}, {5, 8, 8}, {8, 5, 8}}), around,
       kTouching},
      {"a tetrahedron across a dodecahedron's edge", hull({{-8, 6, 3}, {8, 6, 3}, {0, 9, 2}, {0, 9, 4}}), around,
       kTouching},
      {"a tetrahedron's edge from vertex to vertex of a dodecahedron",
       hull({{0, 6, 3}, {0, 6, -3}, {1, 9, 0}, {-1, 9, 0}}), around, kTouching},
      {"a cube in a dodecahedron, edges on faces", cube8, around, kInner},
      {"a tetrahedron in a cube, edges on faces", tetrahedron, cube8, kInner},
      {"an octahedron in a cube, vertices on faces", octahedron, cube8, kInner},
      {"an octahedron in a cut cube, vertices on vertices", octahedron, block({-4, 0, 4}, {-4, 0, 4}, {-4, 0, 4}, 9),
       kInner},
      {"a cube in an octahedron, vertices on faces", box({-1, -1, -1}, {1, 1, 1}), scaled(octahedron, 0.75, 0.75, 0.75),
       kInner},
      {"a cuboctahedron in a cube, vertices on edges",
       hull({{4, 4, 0},
             {4, -4, 0},
             {-4, 4, 0},
             {-4, -4, 0},
             {4, 0, 4},
             {4, 0, -4},
             {-4, 0, 4},
             {-4, 0, -4},
             {0, 4, 4},
             {0, 4, -4},
             {0, -4, 4},
             {0, -4, -4}}),
       cube8, kInner},
      {"an octahedron in a tetrahedron, vertices on edges", octahedron, tetrahedron, kInner},
      {"an octahedron out of a cube", scaled(octahedron, 1.5, 1.5, 1.5), cube8, kPenetrating},
      {"an octahedron whose edges end on a cube's edges", scaled(octahedron, 2, 2, 2), cube8, kPenetrating},
      {"an octahedron around a cube, its faces on vertices", scaled(octahedron, 3, 3, 3), cube8, kOuter},
  };
}

}  // namespace impinge::scenes
