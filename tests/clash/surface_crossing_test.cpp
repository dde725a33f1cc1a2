// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Surfaces at each other's edges: whether they pass through each other is plain, and must not change with a tolerance
/// nor with what a motion rounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;

/// Points (x, z), one after the other.
using Profile = std::vector<std::array<double, 2>>;

/// A profile along y, cut at each of `places`.
MeshData swept(const Profile& profile, const std::vector<double>& places) {
  MeshData mesh;
  for (const double y : places)
    for (const auto& [x, z] : profile) mesh.xyz.insert(mesh.xyz.end(), {x, y, z});
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t j = 0; j + 1 < places.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i, b = a + 1, c = b + n, d = a + n;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

/// A convex plate, as a fan from its first corner.
MeshData plate(const std::vector<std::array<double, 3>>& corners) {
  MeshData mesh;
  for (const auto& corner : corners) mesh.xyz.insert(mesh.xyz.end(), corner.begin(), corner.end());
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) mesh.triangles.insert(mesh.triangles.end(), {0, i, i + 1});
  return mesh;
}

/// Without the triangles that lie in the plane z = `height`.
MeshData open_at(MeshData mesh, double height) {
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto is_there = [&](std::size_t k) { return mesh.xyz[3 * mesh.triangles[t + k] + 2] == height; };
    if (is_there(0) && is_there(1) && is_there(2)) continue;
    for (std::size_t k = 0; k < 3; ++k) kept.push_back(mesh.triangles[t + k]);
  }
  mesh.triangles = kept;
  return mesh;
}

/// Every other triangle looks the other way.
MeshData mixed_up(MeshData mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 6) std::swap(mesh.triangles[t], mesh.triangles[t + 1]);
  return mesh;
}

std::string_view verdict(const MeshData& a, const MeshData& b, const Pose& pose, std::optional<double> tolerance) {
  ClashOptions options;
  options.tolerance = tolerance;
  return name(judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options).value().verdict);
}

void expect_verdict(Verdict expected, const MeshData& a, const MeshData& b, const char* what) {
  EXPECT_EQ(verdict(a, b, {}, 0), name(expected)) << what << ", exactly";
  for (const std::optional<double> tolerance : {std::optional<double>(), {1e-3}})
    for (std::uint64_t seed = 0; seed <= 4u; ++seed) {
      test::Seeded seeded(seed);
      const Pose pose = seed == 0 ? Pose{} : scenes::random_motion(seeded.random, 10);
      const MeshData baked_a = scenes::baked(a, pose), baked_b = scenes::baked(b, pose);
      EXPECT_EQ(verdict(a, b, pose, tolerance), name(expected)) << what << ", seed " << seed;
      EXPECT_EQ(verdict(b, a, pose, tolerance), name(expected)) << what << ", swapped, seed " << seed;
      EXPECT_EQ(verdict(baked_a, mixed_up(baked_b), {}, tolerance), name(expected)) << what << ", baked, seed " << seed;
      EXPECT_EQ(verdict(baked_b, mixed_up(baked_a), {}, tolerance), name(expected))
          << what << ", baked and swapped, seed " << seed;
    }
}

TEST(SurfaceCrossing, APlateThroughAFold) {
  const Profile corner{{0, 4}, {0, 0}, {4, 0}}, straight{{-4, -4}, {4, 4}}, cut{{-4, -4}, {0, 0}, {4, 4}};
  const MeshData fold = swept(corner, {0, 8});
  expect_verdict(Verdict::crossing, fold, swept(straight, {2, 6}), "a plate");
  expect_verdict(Verdict::crossing, fold, swept(cut, {2, 6}), "one that is cut there");
  expect_verdict(Verdict::crossing, fold, swept(straight, {-2, 10}), "one that is longer");
  expect_verdict(Verdict::crossing, swept(corner, {0, 2, 3, 6, 8}), swept(cut, {2, 3, 6}), "both in pieces");
  expect_verdict(Verdict::touching, fold, swept({{-4, -4}, {0, 0}}, {2, 6}), "one that ends there, from without");
  expect_verdict(Verdict::touching, fold, swept({{0, 0}, {4, 4}}, {2, 6}), "one that ends there, from within");
  expect_verdict(Verdict::touching, fold, swept({{-4, 4}, {0, 0}, {4, -4}}, {2, 6}), "one on its back");
  expect_verdict(Verdict::touching, fold, swept({{-4, 4}, {4, -4}}, {2, 6}), "one on its back, in one piece");
  expect_verdict(Verdict::touching, fold, swept({{0, -4}, {0, 0}, {-4, 0}}, {2, 6}), "a fold back to back");
  expect_verdict(Verdict::touching, fold, swept({{1, 4}, {0, 0}, {4, 1}}, {2, 6}), "a fold in it");
}

TEST(SurfaceCrossing, PlatesAtTheEdgesOfATank) {
  const MeshData tank = open_at(scenes::box({0, 0, 0}, {10, 10, 10}), 10);
  expect_verdict(Verdict::crossing, tank, plate({{-2, 5, -2}, {3, 5, 3}, {3, 7, 3}, {-2, 7, -2}}), "at the bottom");
  expect_verdict(Verdict::crossing, tank, plate({{-2, -2, 1}, {5, 5, 1}, {5, 5, 6}, {-2, -2, 6}}), "upright");
  expect_verdict(Verdict::touching, tank, plate({{0, 0, 1}, {5, 5, 1}, {5, 5, 6}, {0, 0, 6}}), "upright, within");
  expect_verdict(Verdict::touching, tank, plate({{0, 0, 1}, {-5, -5, 1}, {-5, -5, 6}, {0, 0, 6}}), "a fin");
  expect_verdict(Verdict::touching, tank, plate({{0, 0, 1}, {-5, 0, 1}, {-5, 0, 6}, {0, 0, 6}}), "a fin along a wall");
  expect_verdict(Verdict::touching, tank, plate({{0, 0, 0}, {10, 10, 0}, {10, 10, 10}, {0, 0, 10}}), "a partition");
}

/// The ribs' ends lie on one leg, behind which the other one is near at the ridge.
TEST(SurfaceCrossing, ARibOutsideOfAnAcuteFold) {
  for (const double width : {0.5, 2.0, 3.9, 4.0, 4.1}) {
    const MeshData fold = swept({{-width, 4}, {0, 0}, {width, 4}}, {0, 8});
    expect_verdict(Verdict::touching, fold, plate({{0, 4, 0}, {10, 4, 0}, {10, 4, 4}, {width, 4, 4}}), "a rib");
    expect_verdict(Verdict::touching, fold, plate({{0, 4, -2}, {10, 4, -2}, {10, 4, 4}, {width, 4, 4}, {0, 4, 0}}),
                   "one that goes on past the ridge");
    expect_verdict(Verdict::crossing, fold, plate({{0, 4, -2}, {10, 4, -2}, {10, 4, 4}, {0, 4, 4}}), "a wall");
  }
  const MeshData roof = swept({{-2, 0}, {0, 6}, {2, 0}}, {0, 10});
  expect_verdict(Verdict::touching, roof, plate({{0, 3, 6}, {2, 3, 0}, {6, 3, 0}, {6, 3, 6}}), "a gable outside");
  expect_verdict(Verdict::touching, roof, plate({{-2, 3, 0}, {2, 3, 0}, {0, 3, 6}}), "a gable within");
  const MeshData pyramid = open_at(scenes::hull({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {0, 0, 9}}), 0);
  expect_verdict(Verdict::touching, pyramid, plate({{2, 0, 0}, {0, 0, 9}, {8, 0, 9}, {8, 0, 0}}), "a fin on a face");
  expect_verdict(Verdict::touching, pyramid, plate({{2, 2, 0}, {0, 0, 9}, {8, 8, 9}}), "a fin on an edge");
  expect_verdict(Verdict::crossing, pyramid, plate({{3, 3, 0}, {0, 0, 0}, {0, 0, 9}, {3, 3, 9}}), "along an edge");
}

/// Between the ridge and a sheet behind it nothing is farther than the tolerance from both.
TEST(SurfaceCrossing, APlateThroughARidgeUpToTheNextSheet) {
  constexpr double kTolerance = 1e-2;
  const MeshData roof = swept({{-2, -4}, {0, 0}, {2, -4}}, {0, 8});
  for (const double gap : {1.8, 8.0}) {
    const double height = gap * kTolerance;
    const MeshData both = scenes::joined(roof, swept({{-2, height}, {2, height}}, {0, 8}));
    const MeshData post = swept({{0, -3}, {0, height}}, {2, 6});
    const Verdict expected = gap < 2 ? Verdict::touching : Verdict::crossing;
    EXPECT_EQ(verdict(both, post, {}, kTolerance), name(expected)) << gap;
    EXPECT_EQ(verdict(post, both, {}, kTolerance), name(expected)) << gap;
    EXPECT_EQ(verdict(roof, post, {}, kTolerance), name(Verdict::crossing)) << gap;
  }
}

TEST(SurfaceCrossing, APlateOnTheWebOfAT) {
  for (const bool is_cut : {false, true}) {
    const Profile flange = is_cut ? Profile{{-3, 0}, {0, 0}, {3, 0}} : Profile{{-3, 0}, {3, 0}};
    for (const std::vector<double>& places : {std::vector<double>{0, 8}, {0, 2, 4, 6, 8}}) {
      const MeshData t = scenes::joined(swept(flange, places), swept({{0, 0}, {0, -5}}, places));
      expect_verdict(Verdict::crossing, t, swept({{0, 2}, {0, -4}}, {2, 6}), "through the flange");
      expect_verdict(Verdict::crossing, t, swept({{0, 2}, {0, 0}, {0, -4}}, {2, 6}), "through it, and cut there");
      expect_verdict(Verdict::touching, t, swept({{0, 0}, {0, -4}}, {2, 6}), "up to the flange");
      expect_verdict(Verdict::touching, t, swept({{0, 3}, {0, 0}}, {2, 6}), "on the flange");
      expect_verdict(Verdict::touching, t, swept({{-1, 0}, {4, 0}}, {2, 6}), "along the flange");
    }
  }
}

/// A sheet that ends a few tolerances above and below another one, each triangle within less than that of it.
TEST(SurfaceCrossing, ASheetThroughANearlyFlushOne) {
  constexpr double kTolerance = 1e-3;
  const auto sheet = [](double height, std::uint32_t pieces) {
    Profile profile;
    std::vector<double> places;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
      const double at = double(i) / pieces;
      profile.push_back({5 * at - 2.5, height * (2 * at - 1)}), places.push_back(6 * at);
    }
    return swept(profile, places);
  };
  for (const double height : {2.5, 10.0, 30.0, 300.0})
    for (const std::uint32_t pieces : {1U, 10U, 30U}) {
      test::Seeded seeded(pieces);
      const Pose pose = scenes::random_motion(seeded.random, 10);
      const MeshData through = sheet(height * kTolerance, pieces + 1);
      EXPECT_EQ(verdict(sheet(0, pieces), through, pose, kTolerance), name(Verdict::crossing)) << height;
      EXPECT_EQ(verdict(through, sheet(0, pieces), pose, kTolerance), name(Verdict::crossing)) << height;
    }
}

/// Half-planes that begin at one line, in the order of their angles: two sheets of two each pass through each other if
/// and only if one's are on different sides of the other's.
TEST(SurfaceCrossing, TwoSheetsAroundALine) {
  const Profile rays{{4, 0},  {4, 2},   {4, 4},   {2, 4},   {0, 4},  {-2, 4}, {-4, 4}, {-4, 2},
                     {-4, 0}, {-4, -2}, {-4, -4}, {-2, -4}, {0, -4}, {2, -4}, {4, -4}, {4, -2}};
  test::Seeded seeded(1);
  const auto judged = [&](std::size_t i, std::size_t j, std::size_t k) {
    const MeshData a = swept({rays[0], {0, 0}, rays[i]}, {0, 8}), b = swept({rays[j], {0, 0}, rays[k]}, {2, 6});
    const Verdict expected = (j < i) != (k < i) ? Verdict::crossing : Verdict::touching;
    const std::string what = std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(k);
    const Pose pose = scenes::random_motion(seeded.random, 10);
    EXPECT_EQ(verdict(a, b, {}, 0), name(expected)) << what;
    EXPECT_EQ(verdict(a, b, {}, std::nullopt), name(expected)) << what;
    EXPECT_EQ(verdict(b, a, pose, std::nullopt), name(expected)) << what << ", moved";
    EXPECT_EQ(verdict(scenes::baked(a, pose), mixed_up(scenes::baked(b, pose)), {}, 1e-3), name(expected)) << what;
  };
  for (std::size_t i = 2; i < rays.size(); ++i)
    for (std::size_t j = 1; j < rays.size(); ++j)
      for (std::size_t k = j + 1; k < rays.size(); ++k)
        if (j != i && k != i) judged(i, j, k);
}

/// Each triangle twice, in opposite winding, as what is to be seen from both sides.
MeshData double_sided(MeshData mesh) {
  const std::size_t size = mesh.triangles.size();
  for (std::size_t t = 0; t < size; t += 3)
    for (const std::size_t k : {0, 2, 1}) mesh.triangles.push_back(mesh.triangles[t + k]);
  return mesh;
}

/// A closed shell without a width: of what `swept` made, the backs' quads have the other diagonal.
MeshData flat_shell(MeshData mesh) {
  const std::size_t size = mesh.triangles.size();
  for (std::size_t t = 0; t < size; t += 6) {
    const std::uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1];
    const std::uint32_t c = mesh.triangles[t + 2], d = mesh.triangles[t + 5];
    mesh.triangles.insert(mesh.triangles.end(), {a, d, b, b, d, c});
  }
  return mesh;
}

/// What stands on such a plate is on one side of it, however fine either is beside the tolerance.
TEST(SurfaceCrossing, WallsOnADoubleSidedPlate) {
  const std::vector<double> across{-512, -256, 0, 256, 512};
  const Profile flat{{-512, 0}, {-256, 0}, {0, 0}, {256, 0}, {512, 0}};
  const MeshData plate = swept(flat, across);
  const std::vector<double> places{-200, -168, -136, -104, -72, -40, 40, 72, 200};
  const MeshData standing = swept({{50, 0}, {50, 32}, {50, 64}, {50, 96}}, places);
  const MeshData hanging = swept({{50, 0}, {50, -32}, {50, -64}, {50, -96}}, places);
  const MeshData through = swept({{50, 64}, {50, 32}, {50, 0}, {50, -32}, {50, -64}}, places);
  const MeshData fold = swept({{20, 64}, {50, 0}, {90, 64}}, places);
  const auto expect = [](Verdict expected, const MeshData& a, const MeshData& b, const std::string& what) {
    EXPECT_EQ(verdict(a, b, {}, 0), name(expected)) << what;
    for (const double tolerance : {0.0625, 0.5, 1.0, 2.0}) {
      test::Seeded seeded(1);
      const Pose pose = scenes::random_motion(seeded.random, 1000);
      EXPECT_EQ(verdict(a, b, {}, tolerance), name(expected)) << what << ", tolerance " << tolerance;
      EXPECT_EQ(verdict(b, a, pose, tolerance), name(expected)) << what << ", moved, tolerance " << tolerance;
    }
  };
  // Finer than lines can be told from, so that what is on the outer side of the fold must be.
  Profile corner, diagonal;
  std::vector<double> rows;
  for (int k = -8; k <= 8; ++k) {
    corner.push_back({std::max(8.0 * k, 0.0), std::max(-8.0 * k, 0.0)});
    diagonal.push_back({6.0 * k, 6.0 * k});
    rows.push_back(8.0 * k);
  }
  expect(Verdict::crossing, double_sided(swept(corner, rows)), swept(diagonal, rows), "through a fold");
  const std::vector<std::pair<std::string, MeshData>> plates{{"double-sided", double_sided(plate)},
                                                             {"mixed up", mixed_up(double_sided(plate))},
                                                             {"a shell", flat_shell(plate)}};
  for (const auto& [what, of_plate] : plates) {
    expect(Verdict::touching, of_plate, standing, what + ", standing");
    expect(Verdict::touching, of_plate, hanging, what + ", hanging");
    expect(Verdict::touching, of_plate, fold, what + ", a fold");
    expect(Verdict::crossing, of_plate, through, what + ", through");
    expect(Verdict::touching, of_plate, double_sided(standing), what + ", double-sided, standing");
    expect(Verdict::touching, of_plate, double_sided(fold), what + ", a double-sided fold");
    expect(Verdict::crossing, of_plate, double_sided(through), what + ", double-sided, through");
    expect(Verdict::touching, of_plate, flat_shell(standing), what + ", a shell, standing");
    expect(Verdict::crossing, of_plate, flat_shell(through), what + ", a shell, through");
  }
}

/// Half-planes at one line; opposite ones are three planes.
constexpr std::size_t kRays = 6;
const Profile kStar{{4, 0}, {4, 4}, {0, 4}, {-4, 0}, {-4, -4}, {0, -4}};

bool has_ray(unsigned rays, std::size_t i) { return (rays >> (i % kRays) & 1) != 0; }

/// All are cut at the line, and hang together there.
MeshData star(unsigned rays, const std::vector<double>& places, int cells = 1) {
  MeshData mesh;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!has_ray(rays, i)) continue;
    Profile ray;
    for (int k = 0; k <= cells; ++k) ray.push_back({kStar[i][0] * k / cells, kStar[i][1] * k / cells});
    mesh = scenes::joined(mesh, swept(ray, places));
  }
  return mesh;
}

/// The same, of whole planes.
MeshData planes(unsigned rays, const std::vector<double>& places) {
  MeshData mesh;
  for (std::size_t i = 0; i < kRays / 2; ++i)
    if (has_ray(rays, i)) mesh = scenes::joined(mesh, swept({kStar[i], kStar[i + kRays / 2]}, places));
  return mesh;
}

/// Four half-planes, of one surface and the other by turns; those of both count as either.
bool alternate(unsigned a, unsigned b) {
  for (std::size_t i = 0; i < kRays; ++i)
    for (std::size_t j = i + 1; j < i + kRays; ++j)
      for (std::size_t k = j + 1; k < i + kRays; ++k)
        for (std::size_t l = k + 1; l < i + kRays; ++l)
          if (has_ray(a, i) && has_ray(b, j) && has_ray(a, k) && has_ray(b, l)) return true;
  return false;
}

/// Once of all that are turned into each other.
bool is_first(unsigned a, unsigned b) {
  const auto turn = [](unsigned rays) { return (rays << 1 | rays >> (kRays - 1)) & ((1U << kRays) - 1); };
  unsigned p = a, q = b;
  for (std::size_t i = 0; i < kRays; ++i)
    if (p = turn(p), q = turn(q); std::pair(p, q) < std::pair(a, b)) return false;
  return true;
}

bool is_forked(unsigned rays) { return ((rays | rays >> 3) & 7) == 7; }

bool is_branched(unsigned rays) { return std::popcount(rays) > 2; }

TEST(SurfaceCrossing, AnySheetsAroundALine) {
  const std::vector<double> whole{0, 8}, part{2, 6};
  test::Seeded seeded(1);
  for (unsigned a = 1; a < 1U << kRays; ++a)
    for (unsigned b = 1; b < 1U << kRays; ++b) {
      if (!is_first(a, b)) continue;
      const Verdict expected = alternate(a, b) ? Verdict::crossing : Verdict::touching;
      const std::string what = std::to_string(a) + " " + std::to_string(b);
      const MeshData of_a = star(a, whole), of_b = star(b, part);
      EXPECT_EQ(verdict(of_a, of_b, {}, 0), name(expected)) << what;
      const Pose pose = scenes::random_motion(seeded.random, 10);
      EXPECT_EQ(verdict(of_b, of_a, pose, std::nullopt), name(expected)) << what << ", moved";
    }
}

/// The same in triangles too narrow for lines to be told from. What is on the outer side of where three legs that are
/// in three planes meet may be missed.
TEST(SurfaceCrossing, FineSheetsAroundALine) {
  const std::vector<double> whole{0, 1, 2, 3, 4, 5, 6, 7, 8}, part{2, 3, 4, 5, 6};
  for (unsigned a = 1; a < 1U << kRays; ++a)
    for (unsigned b = 1; b < 1U << kRays; ++b) {
      if (!is_first(a, b)) continue;
      const Verdict expected = alternate(a, b) ? Verdict::crossing : Verdict::touching;
      const bool may_be_missed = is_forked(a) || is_forked(b) || (is_branched(a) && is_branched(b));
      if (expected == Verdict::crossing && may_be_missed) continue;
      const std::string what = std::to_string(a) + " " + std::to_string(b);
      const MeshData of_a = star(a, whole, 4), of_b = star(b, part, 4);
      EXPECT_EQ(verdict(of_b, mixed_up(of_a), {}, 0x1p-4), name(expected)) << what;
    }
}

/// Planes cross by the signs of their corners, unless they are one; however they are cut.
TEST(SurfaceCrossing, PlanesThroughALine) {
  const std::vector<double> whole{0, 8}, part{2, 6}, many{2, 2.5, 4, 6};
  for (const unsigned a : {1U, 3U, 7U})
    for (unsigned b = 1; b < 8; ++b) {
      const bool is_one = a == b && (a & (a - 1)) == 0;
      const Verdict expected = is_one ? Verdict::touching : Verdict::crossing;
      const std::string what = std::to_string(a) + " " + std::to_string(b);
      const unsigned rays_a = a | a << 3, rays_b = b | b << 3;
      expect_verdict(expected, planes(rays_a, whole), planes(rays_b, part), what.c_str());
      expect_verdict(expected, planes(rays_a, whole), star(rays_b, many), (what + ", b in halves").c_str());
      expect_verdict(expected, star(rays_a, whole), planes(rays_b, part), (what + ", a in halves").c_str());
      expect_verdict(expected, star(rays_a, whole), star(rays_b, many), (what + ", both in halves").c_str());
    }
}

/// A sheet that comes down onto another, runs along it for a while and goes on below, or up again: all along they lie
/// in one plane, cut alike or not.
TEST(SurfaceCrossing, AlongAnAreaOfManyPieces) {
  const auto run = [](double from, double step, double to) {
    Profile profile;
    for (double x = from; x <= to; x += step) profile.push_back({x, 0});
    return profile;
  };
  const auto between = [](const std::array<double, 2>& first, Profile profile, const std::array<double, 2>& last) {
    profile.insert(profile.begin(), first), profile.push_back(last);
    return profile;
  };
  const std::vector<double> rows{0, 1, 2, 3};
  const MeshData through = swept(between({-1, 2}, run(0, 1, 8), {9, -2}), rows);
  const MeshData back = swept(between({-1, 2}, run(0, 1, 8), {9, 2}), rows);
  for (const double step : {1.0, 0.75}) {
    for (const std::vector<double>& places : {rows, {-1, 1.5, 5}}) {
      const MeshData floor = swept(run(-3, step, 12), places);
      const std::string what = "cut by " + std::to_string(step) + " into " + std::to_string(places.size());
      expect_verdict(Verdict::crossing, through, floor, what.c_str());
      expect_verdict(Verdict::touching, back, floor, what.c_str());
      EXPECT_EQ(verdict(through, double_sided(floor), {}, 0), name(Verdict::crossing)) << what;
      EXPECT_EQ(verdict(double_sided(back), floor, {}, 0), name(Verdict::touching)) << what;
      EXPECT_EQ(verdict(double_sided(through), double_sided(floor), {}, 0), name(Verdict::crossing)) << what;
      EXPECT_EQ(verdict(double_sided(back), double_sided(floor), {}, 0), name(Verdict::touching)) << what;
    }
  }
}

}  // namespace
}  // namespace impinge
