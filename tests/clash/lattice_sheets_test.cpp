// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Random surfaces of lattice triangles: what rounding parts must not change what they are to each other. What they are
/// is known exactly where nothing was moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::Random;

using Point = std::array<int, 3>;
using Sheet = std::vector<std::array<Point, 3>>;

Point point(Random& random, int size) {
  return {random.integer(0, size), random.integer(0, size), random.integer(0, size)};
}

bool is_degenerate(const std::array<Point, 3>& t) {
  Point u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) u[k] = t[1][k] - t[0][k], v[k] = t[2][k] - t[0][k];
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

/// Triangles at each other's edges; now and then one that stands alone.
Sheet patch(Random& random, int size) {
  const auto count = static_cast<std::size_t>(random.integer(1, 5));
  Sheet sheet;
  while (sheet.size() < count) {
    std::array<Point, 3> t{point(random, size), point(random, size), point(random, size)};
    if (!sheet.empty() && random.integer(0, 5) > 0) {
      const auto& beside = sheet[static_cast<std::size_t>(random.integer(0, static_cast<int>(sheet.size()) - 1))];
      const auto edge = static_cast<std::size_t>(random.integer(0, 2));
      t[0] = beside[(edge + 1) % 3], t[1] = beside[edge];
    }
    if (!is_degenerate(t)) sheet.push_back(t);
  }
  return sheet;
}

/// High: its angles are acute, down to two degrees.
Sheet tall(Random& random) {
  Sheet sheet = patch(random, 2);
  for (auto& t : sheet)
    for (Point& p : t) p[2] *= 16;
  return sheet;
}

void add_plate(Sheet& sheet, const std::array<Point, 4>& p, bool other_way) {
  if (other_way)
    sheet.insert(sheet.end(), {{p[0], p[1], p[3]}, {p[1], p[2], p[3]}});
  else
    sheet.insert(sheet.end(), {{p[0], p[1], p[2]}, {p[0], p[2], p[3]}});
}

/// Plates that end at one line, others over each piece of it.
Sheet around_a_line(Random& random) {
  Sheet sheet;
  int y = random.integer(0, 2);
  for (int pieces = random.integer(1, 3); pieces > 0; --pieces) {
    const int end = y + random.integer(1, 2);
    for (int plates = random.integer(1, 3); plates > 0; --plates) {
      const int x = random.integer(-2, 2), z = x == 0 ? 1 - 2 * random.integer(0, 1) : random.integer(-2, 2);
      if (random.integer(0, 1) == 0)
        sheet.push_back({Point{0, y, 0}, {0, end, 0}, {x, y, z}});
      else
        add_plate(sheet, {Point{0, y, 0}, {0, end, 0}, {x, end, z}, {x, y, z}}, random.integer(0, 1) == 0);
    }
    y = end + (random.integer(0, 3) == 0 ? 1 : 0);
  }
  return sheet;
}

/// A profile that may branch, along y: two of them share areas.
Sheet profile(Random& random) {
  Sheet sheet;
  std::vector<std::array<int, 2>> at{{random.integer(0, 2), random.integer(0, 2)}};
  while (sheet.empty() || random.integer(0, 2) > 0) {
    const auto [x, z] = at[static_cast<std::size_t>(random.integer(0, static_cast<int>(at.size()) - 1))];
    const std::array<int, 2> next{random.integer(0, 2), random.integer(0, 2)};
    if (next == std::array{x, z}) continue;
    at.push_back(next);
    const int end = random.integer(3, 5);
    for (int y = random.integer(0, 2), step = 0; y < end; y += step) {
      step = std::min(random.integer(1, 3), end - y);
      add_plate(sheet, {Point{x, y, z}, {next[0], y, next[1]}, {next[0], y + step, next[1]}, {x, y + step, z}},
                random.integer(0, 1) == 0);
    }
  }
  return sheet;
}

MeshData mesh_of(const Sheet& sheet) {
  MeshData mesh;
  std::map<Point, std::uint32_t> vertices;
  for (const auto& t : sheet)
    for (const Point& p : t) {
      const auto [at, is_new] = vertices.try_emplace(p, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) mesh.xyz.insert(mesh.xyz.end(), p.begin(), p.end());
      mesh.triangles.push_back(at->second);
    }
  return mesh;
}

/// Each vertex by itself, by up to `most` along each axis.
MeshData shaken(MeshData mesh, double most, Random& random) {
  for (double& x : mesh.xyz) x += random.uniform(-most, most);
  return mesh;
}

std::string verdict(const MeshData& a, const MeshData& b, const Pose& pose, std::optional<double> tolerance) {
  ClashOptions options;
  options.tolerance = tolerance;
  return std::string(name(judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options).value().verdict));
}

template <class Draw>
void expect_same_verdicts(const Draw& draw_sheet) {
  constexpr double kTolerance = 0x1p-10;
  std::map<std::string, int> met;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::Seeded seeded(seed);
    Random& random = seeded.random;
    const MeshData a = mesh_of(draw_sheet(random)), b = mesh_of(draw_sheet(random));
    // What is closed may be a solid.
    if (examine(test::mesh_of(a))->closed || examine(test::mesh_of(b))->closed) continue;
    const std::string expected = verdict(a, b, {}, 0);
    ++met[expected];
    EXPECT_EQ(verdict(a, b, {}, std::nullopt), expected);
    EXPECT_EQ(verdict(shaken(a, kTolerance / 4, random), shaken(b, kTolerance / 4, random), {}, kTolerance), expected);
    for (const double far : {0.0, 10.0}) {
      const Pose pose = scenes::random_motion(random, far);
      EXPECT_EQ(verdict(a, b, pose, std::nullopt), expected);
      EXPECT_EQ(verdict(scenes::baked(b, pose), scenes::baked(a, pose), {}, kTolerance), expected);
    }
  }
  EXPECT_GT(met["crossing"], 5);
  EXPECT_GT(met["touching"], 20);
}

TEST(LatticeSheets, Patches) {
  expect_same_verdicts([](Random& random) { return patch(random, 1); });
  expect_same_verdicts([](Random& random) { return patch(random, 2); });
  expect_same_verdicts([](Random& random) { return patch(random, 3); });
}
TEST(LatticeSheets, AcutePatches) { expect_same_verdicts(tall); }
TEST(LatticeSheets, PlatesAroundALine) { expect_same_verdicts(around_a_line); }
TEST(LatticeSheets, Profiles) { expect_same_verdicts(profile); }

}  // namespace
}  // namespace impinge
