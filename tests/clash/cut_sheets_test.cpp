// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Rectangles on a coarse lattice, cut a few tolerances beside where they meet, shaken by less than the tolerance and
/// turned. Whether two of them pass through each other is plain from their extents.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string_view>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/random.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::Random;

constexpr double kTolerance = 1, kCell = 64 * kTolerance;

/// Across an axis, in cells of the lattice; one side has no extent.
struct Rectangle {
  std::size_t axis;
  std::array<int, 3> lo, hi;
};

Rectangle rectangle(Random& random) {
  Rectangle r{static_cast<std::size_t>(random.integer(0, 2)), {}, {}};
  for (std::size_t k = 0; k < 3; ++k) r.lo[k] = random.integer(0, 3), r.hi[k] = random.integer(r.lo[k] + 1, 4);
  r.lo[r.axis] = r.hi[r.axis] = random.integer(1, 3);
  return r;
}

bool meet(const Rectangle& a, const Rectangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::max(a.lo[k], b.lo[k]) > std::min(a.hi[k], b.hi[k])) return false;
  return true;
}

/// In one plane, and with no area in common.
bool are_neighbours(const Rectangle& a, const Rectangle& b) {
  const std::size_t first = (a.axis + 1) % 3, second = (a.axis + 2) % 3;
  return a.axis == b.axis && a.lo[a.axis] == b.lo[a.axis] &&
         (std::max(a.lo[first], b.lo[first]) >= std::min(a.hi[first], b.hi[first]) ||
          std::max(a.lo[second], b.lo[second]) >= std::min(a.hi[second], b.hi[second]));
}

/// Each goes on, on both sides of the other, over a line that has a length.
bool cross(const Rectangle& a, const Rectangle& b) {
  if (a.axis == b.axis) return false;
  const auto goes_through = [](const Rectangle& one, const Rectangle& other) {
    return one.lo[other.axis] < other.lo[other.axis] && other.lo[other.axis] < one.hi[other.axis];
  };
  const std::size_t along = 3 - a.axis - b.axis;
  return goes_through(a, b) && goes_through(b, a) &&
         std::max(a.lo[along], b.lo[along]) < std::min(a.hi[along], b.hi[along]);
}

/// Cut near lattice lines, up to so far beside them.
std::vector<double> places(int lo, int hi, double beside, double slit, Random& random) {
  const auto end = [&] { return slit > 0 ? random.uniform(0.8, 0.8 + slit) : random.uniform(-0.3, 0.3); };
  std::vector<double> places{lo * kCell + end() * kTolerance};
  for (int line = lo + 1; line < hi; ++line)
    if (random.integer(0, 3) > 0)
      places.push_back(line * kCell + random.integer(0, 3) * random.uniform(-beside, beside) / 3 * kTolerance);
  places.push_back(hi * kCell - end() * kTolerance);
  return places;
}

void add(MeshData& mesh, const Rectangle& r, double beside, double slit, Random& random) {
  const std::size_t first = (r.axis + 1) % 3, second = (r.axis + 2) % 3;
  const std::vector<double> x = places(r.lo[first], r.hi[first], beside, slit, random),
                            y = places(r.lo[second], r.hi[second], beside, slit, random);
  const auto base = static_cast<std::uint32_t>(mesh.xyz.size() / 3), row = static_cast<std::uint32_t>(x.size());
  for (const double at_y : y)
    for (const double at_x : x) {
      std::array<double, 3> p{};
      p[r.axis] = r.lo[r.axis] * kCell, p[first] = at_x, p[second] = at_y;
      for (const double at : p) mesh.xyz.push_back(at + random.uniform(-0.2, 0.2) * kTolerance);
    }
  for (std::uint32_t j = 0; j + 1 < y.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = base + j * row + i, b = a + 1, c = b + row, d = a + row;
      if (random.integer(0, 1) == 0)
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, b, c, d});
    }
}

/// A part of up to so many rectangles that do not touch: with slits there are also some that end at one line, more than
/// a tolerance apart.
std::vector<Rectangle> part(int most, double slit, Random& random) {
  std::vector<Rectangle> part;
  const int wanted = random.integer(1, most);
  for (int tries = 0; tries < 20 && static_cast<int>(part.size()) < wanted; ++tries) {
    const Rectangle next = rectangle(random);
    if (std::all_of(part.begin(), part.end(), [&](const Rectangle& other) {
          return !meet(next, other) || (slit > 0 && are_neighbours(next, other));
        }))
      part.push_back(next);
  }
  return part;
}

/// `beside` and `slit` in tolerances: up to how far beside lattice lines they are cut, and how much further than 0.8
/// off such lines they end.
void expect_plain_verdicts(int trials, int most, double beside, double slit) {
  std::map<bool, int> met;
  for (int seed = 1; seed <= trials; ++seed) {
    test::Seeded seeded(static_cast<std::uint64_t>(seed));
    Random& random = seeded.random;
    const std::array parts{part(most, slit, random), part(most, slit, random)};
    bool expected = false;
    for (const Rectangle& a : parts[0])
      for (const Rectangle& b : parts[1]) expected |= cross(a, b);
    ++met[expected];
    std::array<MeshData, 2> meshes;
    for (std::size_t k = 0; k < 2; ++k)
      for (const Rectangle& r : parts[k]) add(meshes[k], r, beside, slit, random);
    const Pose pose = scenes::random_motion(random, 10 * kCell * random.integer(0, 1));
    ClashOptions options;
    options.tolerance = kTolerance;
    for (const bool swap : {false, true}) {
      const Clash clash =
          judge(test::mesh_of(meshes[swap ? 1 : 0]), pose, test::mesh_of(meshes[swap ? 0 : 1]), pose, options).value();
      EXPECT_EQ(clash.verdict == Verdict::crossing, expected) << name(clash.verdict);
    }
  }
  EXPECT_GT(met[true], trials / 100);
  EXPECT_GT(met[false], trials / 2);
}

TEST(CutSheets, SingleRectangles) { expect_plain_verdicts(2000, 1, 4, 0); }
TEST(CutSheets, SeveralRectangles) {
  expect_plain_verdicts(1000, 3, 4, 0);
  expect_plain_verdicts(1000, 3, 2, 0);
}
TEST(CutSheets, ASlitIsNoSheet) {
  expect_plain_verdicts(1000, 3, 4, 0.2);
  expect_plain_verdicts(1000, 3, 4, 3);
}

/// From a line along y, so far in a direction of x and z, in so many rows.
void add_half(MeshData& mesh, const std::array<double, 2>& at, const std::array<double, 2>& way, int rows) {
  constexpr double kWide = 2000 * kTolerance;
  const auto base = static_cast<std::uint32_t>(mesh.xyz.size() / 3);
  for (int row = 0; row <= rows; ++row)
    for (const double far : {0.0, kWide})
      mesh.xyz.insert(mesh.xyz.end(), {at[0] + far * way[0], kWide * (2.0 * row / rows - 1), at[1] + far * way[1]});
  for (std::uint32_t i = base; i < base + 2 * static_cast<std::uint32_t>(rows); i += 2)
    mesh.triangles.insert(mesh.triangles.end(), {i, i + 1, i + 2, i + 1, i + 3, i + 2});
}

/// A wall through a plate at some angle, each of two halves, and not welded: their sides of a seam may have vertices of
/// their own, and others in between. The nearer seams are to the line, the less is told around it.
void expect_crossing(double degrees, double seam_of_plate, double seam_of_wall, double gap, int rows) {
  const double angle = degrees * std::numbers::pi / 180;
  const std::array<double, 2> along{std::cos(angle), std::sin(angle)}, back{-along[0], -along[1]};
  MeshData plate, wall;
  add_half(plate, {seam_of_plate, 0}, {-1, 0}, 1);
  add_half(plate, {seam_of_plate + gap, 0}, {1, 0}, rows);
  add_half(wall, {seam_of_wall * along[0], seam_of_wall * along[1]}, along, 1);
  add_half(wall, {seam_of_wall * along[0], seam_of_wall * along[1]}, back, 1);
  ClashOptions options;
  options.tolerance = kTolerance;
  const Clash clash = judge(test::mesh_of(plate), {}, test::mesh_of(wall), {}, options).value();
  EXPECT_EQ(name(clash.verdict), "crossing") << degrees << " degrees, seams at " << seam_of_plate << " and "
                                             << seam_of_wall << ", gap " << gap << ", rows " << rows;
}

TEST(CutSheets, AWallThroughAPlateOfTwoHalves) {
  for (const double degrees : {90.0, 70.0, 50.0, 30.0, 20.0})
    for (double of_plate = -3.9; of_plate < 4; of_plate += 0.6)
      for (double of_wall = -3.9; of_wall < 4; of_wall += 0.6)
        for (const int rows : {1, 2}) {
          expect_crossing(degrees, of_plate, of_wall, 0, rows);
          expect_crossing(degrees, of_plate, of_wall, 1e-9, rows);
        }
}

}  // namespace
}  // namespace impinge
