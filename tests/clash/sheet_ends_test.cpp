// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What runs past a surface's end, flush with it or within the tolerance of it, does not go through the surface, though
/// what hangs together with it stands or hangs on the surface elsewhere. In millimetres. And sheets are the same
/// however they are cut, also where corners of some triangles lie within the edges of others.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
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

struct Range {
  double from, to;
  int cells = 1;
  [[nodiscard]] double at(int i) const { return from + (to - from) * i / cells; }
};

/// Rectangles across an axis, at a place of it and over a range of each of the next two.
struct Rectangle {
  std::size_t axis;
  double place;
  Range first, second;
};

MeshData sheets(const std::vector<Rectangle>& rectangles) {
  MeshData mesh;
  for (const auto& [axis, place, first, second] : rectangles) {
    const auto base = static_cast<std::uint32_t>(mesh.xyz.size() / 3);
    for (int j = 0; j <= second.cells; ++j)
      for (int i = 0; i <= first.cells; ++i) {
        std::array<double, 3> p{};
        p[axis] = place, p[(axis + 1) % 3] = first.at(i), p[(axis + 2) % 3] = second.at(j);
        mesh.xyz.insert(mesh.xyz.end(), p.begin(), p.end());
      }
    const auto row = static_cast<std::uint32_t>(first.cells) + 1;
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(second.cells); ++j)
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = base + j * row + i, b = a + 1, c = b + row, d = a + row;
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      }
  }
  return mesh;
}

Rectangle across_x(double x, const Range& y, const Range& z) { return {0, x, y, z}; }
Rectangle across_y(double y, const Range& x, const Range& z) { return {1, y, z, x}; }
Rectangle across_z(double z, const Range& x, const Range& y) { return {2, z, x, y}; }

std::string_view verdict(const MeshData& a, const MeshData& b, const Pose& pose, double tolerance) {
  ClashOptions options;
  options.tolerance = tolerance;
  return name(judge(test::mesh_of(a), pose, test::mesh_of(b), pose, options).value().verdict);
}

void expect_verdict(Verdict expected, const MeshData& a, const MeshData& b, const std::string& what) {
  for (const double tolerance : {0.1, 0.5, 1.0, 2.0})
    for (std::uint64_t seed = 0; seed <= 2u; ++seed) {
      test::Seeded seeded(seed);
      const Pose pose = seed == 0 ? Pose{} : scenes::random_motion(seeded.random, 1000);
      EXPECT_EQ(verdict(a, b, pose, tolerance), name(expected)) << what << ", " << tolerance << ", seed " << seed;
      EXPECT_EQ(verdict(b, a, pose, tolerance), name(expected))
          << what << ", swapped, " << tolerance << ", seed " << seed;
    }
}

/// An angle, one leg of which is cut off so that it stands on the plate; the other runs past the plate's end.
TEST(SheetEnds, ACopedAngle) {
  const MeshData angle = sheets({across_x(0, {0, 50}, {-50, 50, 2}), across_y(0, {0, 50}, {0, 50})});
  for (const double end : {-0.09, -0.05, 0.0}) {
    const std::string what = "the plate ends at " + std::to_string(end);
    expect_verdict(Verdict::touching, angle, sheets({across_z(0, {end, 50}, {-50, 50, 2})}), what);
    expect_verdict(Verdict::touching, angle, sheets({across_z(0, {end, 500}, {-500, 500})}), what);
    expect_verdict(Verdict::touching, angle, sheets({across_z(0, {end, 500, 10}, {-500, 500, 20})}), what);
  }
  expect_verdict(Verdict::crossing, angle, sheets({across_z(0, {-3, 500}, {-500, 500})}), "past the leg");
  const MeshData too_long = sheets({across_x(0, {0, 50}, {-50, 50, 4}), across_y(0, {0, 50}, {-25, 50, 3})});
  expect_verdict(Verdict::crossing, too_long, sheets({across_z(0, {0, 500}, {-500, 500})}), "too long");
}

TEST(SheetEnds, ANotchedAngle) {
  const MeshData angle =
      sheets({across_x(0, {10, 50}, {-50, 50, 2}), across_x(0, {0, 10}, {0, 50}), across_y(0, {0, 50}, {0, 50})});
  expect_verdict(Verdict::touching, angle, sheets({across_z(0, {0, 75}, {-75, 75})}), "beside the notch");
}

TEST(SheetEnds, ASquareTubeWithAWallPastTheEnd) {
  const MeshData plate = sheets({across_z(0, {0, 100}, {-100, 100, 2})});
  const auto tube = [](double foot) {
    return sheets({across_x(0, {-50, 50, 2}, {-100, 50, 3}), across_x(50, {-50, 50, 2}, {foot, 50}),
                   across_y(-50, {0, 50}, {foot, 50}), across_y(50, {0, 50}, {foot, 50})});
  };
  expect_verdict(Verdict::touching, tube(0), plate, "on it");
  expect_verdict(Verdict::crossing, tube(-100), plate, "through it");
}

/// A wall past the end of a plate, with brackets on it: one stands on the plate, one hangs under it.
TEST(SheetEnds, BracketsOnBothSides) {
  for (const int cells : {1, 4, 16}) {
    const Range across{-100, 100, 2 * cells}, half{0, 50, cells};
    const MeshData wall = sheets({across_x(0, across, {-100, 100, 2 * cells}), across_y(-50, half, {0, 100, cells}),
                                  across_y(50, half, {-100, 0, cells})});
    expect_verdict(Verdict::touching, wall, sheets({across_z(0, {0, 100, cells}, across)}), std::to_string(cells));
  }
}

/// A pipe in a hole of its size, with a fin on it that stands on the plate, or goes through it.
TEST(SheetEnds, AFinnedPipeInAHole) {
  constexpr int kSides = 12;
  constexpr double kRadius = 50, kSize = 500, kLength = 200;
  const auto point = [](int i, double radius, double z) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    return std::array{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  const auto add = [](MeshData& mesh, const std::vector<std::array<double, 3>>& corners) {
    const auto base = static_cast<std::uint32_t>(mesh.xyz.size() / 3);
    for (const auto& corner : corners) mesh.xyz.insert(mesh.xyz.end(), corner.begin(), corner.end());
    mesh.triangles.insert(mesh.triangles.end(), {base, base + 1, base + 2, base, base + 2, base + 3});
  };
  const auto add_strip = [&](MeshData& mesh, double r, double r_low, double low, double high) {
    for (int i = 0; i < kSides; ++i)
      add(mesh, {point(i, r_low, low), point((i + 1) % kSides, r_low, low), point((i + 1) % kSides, r, high),
                 point(i, r, high)});
  };
  MeshData plate, pipe;
  add_strip(plate, kSize, kRadius, 0, 0);
  for (const double z : {-kLength, 0.0}) add_strip(pipe, kRadius, kRadius, z, z + kLength);
  MeshData standing = pipe;
  add(standing,
      {point(0, kRadius, 0), point(0, 2 * kRadius, 0), point(0, 2 * kRadius, kLength), point(0, kRadius, kLength)});
  expect_verdict(Verdict::touching, pipe, plate, "a pipe");
  expect_verdict(Verdict::touching, standing, plate, "a fin on the plate");
  MeshData through = standing;
  add(through,
      {point(0, kRadius, -kLength), point(0, 2 * kRadius, -kLength), point(0, 2 * kRadius, 0), point(0, kRadius, 0)});
  expect_verdict(Verdict::crossing, through, plate, "a fin through the plate");
}

/// On both sides of a fold's two ends: what lies across them, flush, is at the end of either.
TEST(SheetEnds, AcrossTheEndsOfAProfile) {
  for (const double over : {0.0, 0.05}) {
    const MeshData profile = sheets(
        {across_x(0, {0, 200, 4}, {0, 20}), across_z(0, {0, 20}, {0, 200, 4}), across_x(20, {0, 200, 4}, {-20, 0})});
    const MeshData plate = sheets({across_y(over, {-50, 50, 10}, {-50, 50, 10})});
    expect_verdict(Verdict::touching, profile, plate, std::to_string(over));
  }
}

/// A square from -50 to 150 in the plane z = 0, cut conformingly or not.
std::vector<std::pair<std::string, MeshData>> squares() {
  const Range all{-50, 150}, low{-50, 50}, high{50, 150};
  return {{"whole", sheets({across_z(0, all, all)})},
          {"halves", sheets({across_z(0, low, all), across_z(0, high, all)})},
          {"a half in two", sheets({across_z(0, low, all), across_z(0, high, low), across_z(0, high, high)})},
          {"a half in seven", sheets({across_z(0, low, all), across_z(0, high, {-50, 150, 7})})},
          {"in three and seven", sheets({across_z(0, low, {-50, 150, 3}), across_z(0, high, {-50, 150, 7})})}};
}

void expect_any_tolerance(Verdict expected, const MeshData& a, const MeshData& b, const std::string& what) {
  EXPECT_EQ(verdict(a, b, {}, 0), name(expected)) << what << ", exactly";
  EXPECT_EQ(verdict(b, a, {}, 0), name(expected)) << what << ", exactly, swapped";
  expect_verdict(expected, a, b, what);
}

/// It comes from above, lies on the square and goes on below, or comes and goes above.
TEST(TJunctions, AProfileAlongASquare) {
  const Range depth{0, 100}, up{0, 50}, down{-50, 0};
  for (const int cells : {1, 3}) {
    const Rectangle flat = across_z(0, {25, 75, cells}, depth);
    const MeshData through = sheets({across_x(25, depth, up), flat, across_x(75, depth, down)});
    const MeshData back = sheets({across_x(25, depth, up), flat, across_x(75, depth, up)});
    for (const auto& [what, square] : squares()) {
      expect_any_tolerance(Verdict::crossing, through, square, what);
      expect_any_tolerance(Verdict::touching, back, square, what);
    }
  }
}

/// A wall that is bent where it passes through another, its two sides cut alike or not.
TEST(TJunctions, AFoldThroughAWall) {
  const Range height{-50, 150};
  const MeshData wall = sheets({across_x(0, {0, 50}, {0, 100}), across_x(0, {50, 100}, {0, 100})});
  for (const int cells : {1, 2, 5, 8}) {
    // One side lies across the wall, the other goes on along the diagonal.
    MeshData fold = sheets({across_y(50, {-100, 0, 2}, {height.from, height.to, 8})});
    const MeshData leg = sheets({across_y(50, {0, 100, 2}, {height.from, height.to, cells})});
    MeshData bent = leg;
    for (std::size_t i = 0; i < bent.xyz.size(); i += 3) bent.xyz[i + 1] += bent.xyz[i];
    MeshData outside = leg;
    for (std::size_t i = 0; i < outside.xyz.size(); i += 3) outside.xyz[i + 1] += outside.xyz[i], outside.xyz[i] *= -1;
    expect_any_tolerance(Verdict::crossing, wall, scenes::joined(fold, bent), std::to_string(cells));
    expect_any_tolerance(Verdict::touching, wall, scenes::joined(fold, outside), std::to_string(cells));
  }
}

/// The web of a T ends at a flange that is cut at the line, each part of it in another way.
TEST(TJunctions, APlateOnTheWebOfAT) {
  for (const int cells : {1, 3}) {
    const MeshData t = sheets({across_z(0, {-1200, 0}, {0, 4000, cells}), across_z(0, {0, 1200}, {0, 4000, 4}),
                               across_x(0, {0, 4000, 7}, {-2000, 0})});
    const Range part{1000, 3000};
    expect_any_tolerance(Verdict::crossing, t, sheets({across_x(0, part, {-1600, 800})}), "through the flange");
    expect_any_tolerance(Verdict::touching, t, sheets({across_x(0, part, {-1600, 0})}), "up to the flange");
    expect_any_tolerance(Verdict::touching, t, sheets({across_x(0, part, {0, 800})}), "on the flange");
  }
}

}  // namespace
}  // namespace impinge
