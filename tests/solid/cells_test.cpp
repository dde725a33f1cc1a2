// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "exact/triangle_pair.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/oracle/points.hpp"
#include "tests/solid/placed.hpp"
#include "tests/solid/winding_oracle.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::Random;
using solid::Cells;
using solid::kInside;
using solid::kOtherSide;
using solid::kOutside;
using solid::kSameSide;

struct Shape {
  MeshData mesh;
  Pose pose{};
};

struct Made {
  Mesh mesh;
  solid::Part part;
  explicit Made(const Shape& shape) : mesh(test::mesh_of(shape.mesh)), part(make(mesh, shape)) {}
  static solid::Part make(const Mesh& mesh, const Shape& shape) {
    solid::Body body = solid::make_body(mesh.state().placed(shape.pose));
    solid::Topology topology = solid::examine(body);
    return solid::make_part(std::move(body), std::move(topology), true);
  }
};

std::vector<exact::Contact> contacts_of(const solid::Body& a, const solid::Body& b) {
  std::vector<exact::Contact> contacts;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (const auto kind = exact::classify(a.triangle(i), b.triangle(j))) contacts.push_back({i, j, *kind});
  return contacts;
}

Cells cells_of(
    const Shape& a, const Shape& b, bool (*enough)(const Cells&) = [](const Cells&) { return false; }) {
  const Made made_a(a), made_b(b);
  const auto contacts = contacts_of(made_a.part.body, made_b.part.body);
  return solid::cells_of(made_a.part, made_b.part, contacts, enough);
}

/// As letters, which failures are easier to read by.
std::string letters(std::uint8_t bits) {
  std::string text;
  for (const auto& [bit, letter] : {std::pair{kInside, 'i'}, {kOutside, 'o'}, {kSameSide, 's'}, {kOtherSide, 'd'}})
    if ((bits & bit) != 0) text += letter;
  return text;
}
std::string letters(const Cells& cells) { return letters(cells.a) + "|" + letters(cells.b); }

/// Both ways round, under motions that rounding leaves alone, and with either turned inside out.
void expect_cells(const Shape& a, const Shape& b, const std::string& in_b, const std::string& in_a) {
  ASSERT_EQ(letters(cells_of(a, b)), in_b + "|" + in_a);
  ASSERT_EQ(letters(cells_of(b, a)), in_a + "|" + in_b);
  const auto changed = [&](const Shape& shape, bool invert) {
    Shape other = shape;
    if (invert) other.mesh = scenes::inverted(other.mesh);
    other.pose.R = {0, 1, 0, 0, 0, -1, -1, 0, 0};
    other.pose.t = {0x1p20, -0x1p18, 0x1p10};
    return other;
  };
  for (const int which : {0, 1, 2, 3})
    ASSERT_EQ(letters(cells_of(changed(a, which % 2 == 1), changed(b, which / 2 == 1))), in_b + "|" + in_a);
}

Shape box(const std::array<double, 3>& low, const std::array<double, 3>& high, int n = 1) {
  return {scenes::box(low, high, n)};
}
Shape cube(double x = 0, double y = 0, double z = 0) { return {scenes::shifted(scenes::cube(), x, y, z)}; }

TEST(Cells, OfBoxesThatAreAlignedInOneTwoAndThreePlanes) {
  expect_cells(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3}), "io", "io");
  expect_cells(box({0, 0, 0}, {2, 2, 2}), box({0, 1, 1}, {2, 3, 3}), "ios", "ios");
  expect_cells(box({0, 0, 0}, {2, 2, 2}), box({0, 0, 1}, {2, 2, 3}), "ios", "ios");
  expect_cells(box({0, 0, 0}, {2, 2, 2}), box({0, 0, 0}, {1, 1, 1}), "os", "is");
  expect_cells(box({0, 0, 0}, {2, 2, 2}), box({0, 0, 0}, {2, 2, 1}), "os", "is");
  expect_cells(box({0, 0, 0}, {2, 2, 2}, 3), box({0, 0, 0}, {2, 2, 1}, 2), "os", "is");
  expect_cells(box({-1, 0, 0}, {2, 1, 1}), box({0, -1, 0}, {1, 2, 1}), "ios", "ios");  // a cross
}

TEST(Cells, OfFlushFaces) {
  expect_cells(cube(), cube(1, 0, 0), "od", "od");
  expect_cells(cube(), cube(1, 0.5, 0.25), "od", "od");
  expect_cells(box({0, 0, 0}, {1, 1, 1}, 4), box({1, 0, 0}, {2, 1, 1}, 3), "od", "od");
  expect_cells(box({0, 0, 0}, {1, 1, 1}), box({1, 0.25, 0.25}, {2, 0.5, 0.5}, 2), "od", "od");
  // Edges of the finer one end on the faces and edges of the other.
  expect_cells(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1}, 8), "od", "od");
}

TEST(Cells, OfWhatTouchesWithoutAnArea) {
  expect_cells(cube(), cube(1, 1, 0), "o", "o");
  expect_cells(cube(), cube(1, 1, 0.5), "o", "o");
  expect_cells(cube(), cube(1, 1, 1), "o", "o");
  const Shape tip{test::tetrahedron({Point{0.5, 0.25, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}})};
  expect_cells(cube(), tip, "o", "o");  // a vertex on a face
  const Shape roof{test::tetrahedron({Point{0.25, 0.25, 1}, {0.5, 0.75, 1}, {0, 1, 2}, {1, 0, 2}})};
  expect_cells(cube(), roof, "o", "o");  // an edge on a face
  const Shape across{test::tetrahedron({Point{-1, 0, 2}, {1, 0, 0}, {3, -3, 3}, {3, -3, 1}})};
  expect_cells(cube(-0.5, 0, 0), across, "o", "o");  // an edge across an edge
}

TEST(Cells, OfShellsInShells) {
  const Shape outer = box({0, 0, 0}, {4, 4, 4}, 2);
  expect_cells(outer, box({1, 1, 1}, {3, 3, 3}), "o", "i");
  expect_cells(outer, box({0, 1, 1}, {3, 3, 3}), "os", "is");
  expect_cells(outer, {test::tetrahedron({Point{0, 1, 1}, {2, 1, 1}, {2, 2, 1}, {2, 1, 2}})}, "o", "i");
  const Shape hollow{scenes::joined(outer.mesh, scenes::inverted(scenes::box({1, 1, 1}, {3, 3, 3})))};
  expect_cells(hollow, box({1.5, 1.5, 1.5}, {2, 2, 2}), "o", "o");  // loose in the cavity
  expect_cells(hollow, box({1, 1, 1}, {3, 3, 3}), "od", "d");       // a plug that fills it
  expect_cells(hollow, box({1, 1, 1}, {3, 3, 3}, 3), "od", "d");
  expect_cells(hollow, box({1, 1, 1}, {3, 3, 2}), "od", "od");     // one that fills half of it
  expect_cells(hollow, box({1, 1, 1}, {3, 3, 3.5}), "iod", "id");  // one that is too long
  expect_cells(hollow, outer, "is", "s");                          // and one that leaves no cavity
  expect_cells({scenes::joined(cube().mesh, cube(2, 0, 0).mesh)}, box({0.5, 0.25, 0.25}, {2.5, 0.75, 0.75}), "io",
               "io");
  expect_cells({scenes::joined(cube().mesh, cube(2, 0, 0).mesh)}, cube(1, 0, 0), "od", "od");
}

TEST(Cells, OfDuplicates) {
  expect_cells(cube(), cube(), "s", "s");
  expect_cells(box({0, 0, 0}, {1, 1, 1}, 3), box({0, 0, 0}, {1, 1, 1}, 2), "s", "s");
  expect_cells({scenes::uv_sphere(8, 6)}, {scenes::uv_sphere(8, 6)}, "s", "s");
}

/// Both of a cube's two tetrahedra have only its vertices in common with the dodecahedron's 20.
TEST(Cells, OfATetrahedronInscribedInADodecahedron) {
  // With the golden ratio rounded to 1.625 the faces are not flat, and cut into triangles about their mean points.
  const double g = 1.625, h = 0.625;
  const std::vector<Point> v{{1, 1, 1},    {1, 1, -1},  {1, -1, 1}, {1, -1, -1}, {-1, 1, 1},  {-1, 1, -1}, {-1, -1, 1},
                             {-1, -1, -1}, {0, h, g},   {0, h, -g}, {0, -h, g},  {0, -h, -g}, {h, g, 0},   {h, -g, 0},
                             {-h, g, 0},   {-h, -g, 0}, {g, 0, h},  {g, 0, -h},  {-g, 0, h},  {-g, 0, -h}};
  const int faces[12][5] = {{0, 8, 10, 2, 16},  {0, 16, 17, 1, 12}, {0, 12, 14, 4, 8},  {17, 16, 2, 13, 3},
                            {2, 10, 6, 15, 13}, {4, 18, 6, 10, 8},  {4, 14, 5, 19, 18}, {1, 9, 5, 14, 12},
                            {1, 17, 3, 11, 9},  {3, 13, 15, 7, 11}, {5, 9, 11, 7, 19},  {6, 18, 19, 7, 15}};
  MeshData dodecahedron;
  for (const Point& p : v) dodecahedron.add_vertex(p.x, p.y, p.z);
  for (const auto& face : faces) {
    Point mean{0, 0, 0};
    for (const int i : face) mean = mean + 0.25 * v[static_cast<std::size_t>(i)];  // pushed out a little
    const auto apex = dodecahedron.add_vertex(mean.x, mean.y, mean.z);
    for (std::size_t i = 0; i < 5; ++i)
      dodecahedron.add_triangle(apex, static_cast<std::uint32_t>(face[i]),
                                static_cast<std::uint32_t>(face[(i + 1) % 5]));
  }
  ASSERT_TRUE(Made({dodecahedron}).part.topology.closed);
  expect_cells({dodecahedron}, {test::tetrahedron({v[0], v[3], v[5], v[6]})}, "o", "i");
}

/// A shell with the inside on both its sides bounds nothing, and neither does one with the outside on both.
TEST(Cells, LeaveOutSheetsThatBoundNothing) {
  const Shape twice{scenes::joined(scenes::box({0, 0, 0}, {4, 4, 4}), scenes::box({1, 1, 1}, {3, 3, 3}, 2))};
  expect_cells(twice, box({1, 1, 1}, {3, 3, 3}), "o", "i");
  expect_cells(twice, box({1.5, 1.5, 1.5}, {2, 2, 2}), "o", "i");
  expect_cells(twice, box({2, 2, 2}, {5, 5, 5}), "io", "io");
  expect_cells(twice, box({0, 0, 0}, {4, 4, 4}), "s", "s");
  expect_cells(twice, {test::tetrahedron({Point{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 3}})}, "o", "i");
}

TEST(Cells, StopOnceThereIsEnough) {
  const auto inside = [](const Cells& cells) { return (cells.b & kInside) != 0; };
  const Cells cells = cells_of(box({0, 0, 0}, {2, 2, 2}, 3), box({1, 1, 1}, {3, 3, 3}, 3), inside);
  EXPECT_TRUE(inside(cells));
}

/// Unit cubes of a lattice, some at random: what is inside is known without a mesh.
struct Polycube {
  std::set<std::array<int, 3>> cubes;
  double size = 1;
  Point low{0, 0, 0};

  /// Of a point on no cube's boundary.
  [[nodiscard]] bool contains(const Point& p) const {
    const Point q = p - low;
    return cubes.contains({static_cast<int>(std::floor(q.x / size)), static_cast<int>(std::floor(q.y / size)),
                           static_cast<int>(std::floor(q.z / size))});
  }
  /// Its faces are cut along either diagonal.
  [[nodiscard]] MeshData mesh(Random& random) const {
    std::array<int, 3> first{};
    std::array<std::vector<double>, 3> cuts;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto before = [&](const auto& p, const auto& q) { return p[axis] < q[axis]; };
      const auto [least, greatest] = std::minmax_element(cubes.begin(), cubes.end(), before);
      first[axis] = (*least)[axis];
      for (int i = first[axis]; i <= (*greatest)[axis] + 1; ++i)
        cuts[axis].push_back(component(low, static_cast<int>(axis)) + size * i);
    }
    const auto is_filled = [&](int i, int j, int k) {
      return cubes.contains({first[0] + i, first[1] + j, first[2] + k});
    };
    return scenes::boundary({cuts[0], cuts[1], cuts[2], is_filled}, random.bits());
  }
};

Polycube polycube(Random& random, int n) {
  Polycube result;
  std::array<int, 3> at{0, 0, 0};
  for (int i = 0; i < n; ++i) {
    result.cubes.insert(at);
    at[static_cast<std::size_t>(random.integer(0, 2))] += random.integer(-1, 1);
    if (random.integer(0, 5) == 0) ++at[0], ++at[1];  // edge to edge, or apart
  }
  return result;
}

/// By the definition, at points of each face of `own`: what is just in front and just behind, in both.
std::uint8_t bits_at_samples(const Polycube& own, const Polycube& other) {
  std::uint8_t bits = 0;
  const double step = own.size / 16, beside = 0x1p-10;
  for (const auto& at : own.cubes)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int end : {0, 1})
        for (int i = 0; i < 256; ++i) {
          std::array<double, 3> c{own.size * at[0], own.size * at[1], own.size * at[2]};
          c[axis] += end * own.size;
          c[(axis + 1) % 3] += step * (0.5 + i % 16), c[(axis + 2) % 3] += step * (0.5 + i / 16);
          const Point p = Point{c[0], c[1], c[2]} + own.low;
          std::array<double, 3> n{0, 0, 0};
          n[axis] = beside;
          const Point normal{n[0], n[1], n[2]}, front = p + normal, back = p - normal;
          if (own.contains(front) == own.contains(back)) continue;  // between two cubes
          const bool in_front = other.contains(front), behind = other.contains(back);
          bits |= in_front && behind                ? kInside
                  : !in_front && !behind            ? kOutside
                  : in_front == own.contains(front) ? kSameSide
                                                    : kOtherSide;
        }
    }
  return bits;
}

TEST(Cells, OfLatticeSolidsAreWhatLiesBesidePointsOfTheirFaces) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 150u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const Polycube a = polycube(random, random.integer(1, 12));
    Polycube b = polycube(random, random.integer(1, 12));
    b.size = std::array{1.0, 0.5, 2.0}[static_cast<std::size_t>(random.integer(0, 2))];
    const double grid = random.integer(0, 1) == 0 ? 1 : 0.5;
    b.low = grid * points::integers(-2, 2)(random);
    Shape shape_a{a.mesh(random)}, shape_b{b.mesh(random)};
    if (random.integer(0, 2) == 0) shape_a.mesh = scenes::inverted(shape_a.mesh);
    if (random.integer(0, 2) == 0) shape_b.mesh = scenes::inverted(shape_b.mesh);
    const Cells expected{bits_at_samples(a, b), bits_at_samples(b, a)};
    ASSERT_EQ(letters(cells_of(shape_a, shape_b)), letters(expected));
    seen.insert(letters(expected));
  }
  EXPECT_GE(seen.size(), 10u);
}

oracle::Triangles exact_triangles(const MeshData& mesh) {
  oracle::Triangles triangles;
  for (const Triangle& t : test::world_triangles(test::mesh_of(mesh), {}))
    triangles.push_back({points::exact(t[0]), points::exact(t[1]), points::exact(t[2])});
  return triangles;
}

/// The same at a random point of a triangle, in rational numbers.
std::uint8_t bit_at_sample(const oracle::Triangles& own, const oracle::Triangles& other, std::size_t t,
                           Random& random) {
  const mpq_class nearly_nothing(1, mpz_class(1) << 200);
  mpq_class s(random.integer(1, (1 << 30) - 1), 1 << 30), rest(random.integer(1, (1 << 30) - 1), 1 << 30);
  s.canonicalize(), rest.canonicalize();
  const mpq_class u = rest * (1 - s);
  const oracle::Vec normal =
      oracle::cross(oracle::operator-(own[t][1], own[t][0]), oracle::operator-(own[t][2], own[t][0]));
  if (oracle::is_zero(normal)) return 0;
  const auto contains = [&](const oracle::Triangles& triangles, int way) {
    oracle::Vec p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = own[t][0][k] + s * (own[t][1][k] - own[t][0][k]) + u * (own[t][2][k] - own[t][0][k]) +
             way * nearly_nothing * normal[k];
    return *oracle::winding_number(triangles, p, [&] { return random.integer(-1000000, 1000000); }) != 0;
  };
  const bool own_front = contains(own, 1);
  if (own_front == contains(own, -1)) return 0;
  const bool front = contains(other, 1), back = contains(other, -1);
  return front && back ? kInside : !front && !back ? kOutside : front == own_front ? kSameSide : kOtherSide;
}

/// Samples until all that was found is seen; what is seen was found.
void expect_as_samples(const MeshData& a, const MeshData& b, Random& random) {
  const Cells found = cells_of({a}, {b});
  const oracle::Triangles exact_a = exact_triangles(a), exact_b = exact_triangles(b);
  Cells seen;
  for (int round = 0; round < 3000 && (round < 20 || letters(seen) != letters(found)); ++round) {
    for (std::size_t t = 0; t < exact_a.size(); ++t) seen.a |= bit_at_sample(exact_a, exact_b, t, random);
    for (std::size_t t = 0; t < exact_b.size(); ++t) seen.b |= bit_at_sample(exact_b, exact_a, t, random);
    if (round % 20 == 19) {
      ASSERT_EQ(letters({static_cast<std::uint8_t>(seen.a & ~found.a), static_cast<std::uint8_t>(seen.b & ~found.b)}),
                "|");
    }
  }
  ASSERT_EQ(letters(found), letters(seen));
}

TEST(Cells, OfTetrahedraAreWhatLiesBesideRandomPointsOfThem) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 25u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const auto proper = [&](const points::Source& corner) {
      for (;;) {
        const std::array<Point, 4> p{corner(random), corner(random), corner(random), corner(random)};
        if (orient3d(p[0], p[1], p[2], p[3]) != 0) return p;
      }
    };
    const auto anywhere = points::integers(0, 3);
    const std::array<Point, 4> corners = proper([&](Random& r) { return 2 * anywhere(r); });
    // Corners of the other one are often corners of this one, or in the middle between two.
    const MeshData a = test::tetrahedron(corners),
                   b = test::tetrahedron(proper([&](Random&r) {
                     const auto some = [&] { return corners[static_cast<std::size_t>(r.integer(0, 3))]; };
                     return r.integer(0, 3) == 0 ? 2 * anywhere(r) : 0.5 * (some() + some());
                   }));
    ASSERT_NO_FATAL_FAILURE(expect_as_samples(a, b, random));
    seen.insert(letters(cells_of({a}, {b})));
  }
  EXPECT_GE(seen.size(), 5u);
}

/// A vertex inside and one outside of each other after any motion, however far and however off.
TEST(Cells, OfPlacedMeshes) {
  for (std::uint64_t seed = 1; seed <= 20u; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    Pose pose = scenes::random_motion(random, seed % 2 == 0 ? 1e6 : 1);
    if (seed % 3 == 0) pose.R = scenes::stretched_rotation(random, 9e-7);
    const Shape ball{scenes::uv_sphere(16, 10), pose};
    EXPECT_EQ(letters(cells_of(ball, {scenes::uv_sphere(16, 10), pose})), "s|s");
    EXPECT_EQ(letters(cells_of(ball, {scenes::uv_sphere(9, 7, 0.5), pose})), "o|i");
    EXPECT_EQ(letters(cells_of(ball, {scenes::shifted(scenes::uv_sphere(16, 10), 0.5, 0.25, 0.125), pose})), "io|io");
    EXPECT_EQ(letters(cells_of(ball, {scenes::shifted(scenes::uv_sphere(16, 10), 2.5, 0, 0), pose})), "o|o");
  }
}

}  // namespace
}  // namespace impinge
