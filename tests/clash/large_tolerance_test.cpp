// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Tolerances as large as the triangles, and larger, of parts that are thick enough for them: verdicts that follow from
/// how the shapes were made.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "expect_verdict.hpp"
#include "impinge/clash.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"

namespace impinge {
namespace {

using scenes::box;
using scenes::inverted;
using scenes::joined;
using scenes::MeshData;
using scenes::scaled;
using scenes::shifted;
using scenes::uv_sphere;
using test::expect_verdict;

/// Of a box of 10: four fifths of the tolerance each, as much as it, and 25 times that.
constexpr std::array kCells{32, 25, 1};
constexpr double kTolerance = 0.4;

TEST(LargeTolerance, FinelyCutBoxesOverlapByALittleLessOrMore) {
  for (const auto& [n, m] : {std::pair{32, 12}, {25, 12}, {25, 1}, {1, 12}})
    for (const double part : {0.0, 0.999, 1.001}) {
      SCOPED_TRACE(std::to_string(n) + " and " + std::to_string(m) + " cells, overlap " + std::to_string(part));
      const double depth = part * kTolerance;
      expect_verdict(part < 1 ? Verdict::touching : Verdict::penetrating, box({0, 0, 0}, {10, 10, 10}, n),
                     box({2, 2, 10 - depth}, {8, 8, 16}, m), kTolerance);
    }
}

TEST(LargeTolerance, FinelyCutBoxesStandApart) {
  for (const int n : kCells) {
    const MeshData large = box({0, 0, 0}, {10, 10, 10}, n);
    expect_verdict(Verdict::touching, large, box({2, 2, 10.38}, {8, 8, 16}, 12), kTolerance);
    expect_verdict(Verdict::apart, large, box({2, 2, 10.42}, {8, 8, 16}, 12), kTolerance);
  }
}

/// An octahedron's tip and a wedge's edge, between vertices of the box and on them.
TEST(LargeTolerance, ATipOrAnEdgeReachesIn) {
  const MeshData tip = scenes::hull({{0, 0, 0}, {8, 0, 8}, {-8, 0, 8}, {0, 8, 8}, {0, -8, 8}, {0, 0, 16}});
  const MeshData edge = scenes::hull({{-4, 0, 0}, {4, 0, 0}, {-4, 6, 12}, {4, 6, 12}, {-4, -6, 12}, {4, -6, 12}});
  for (const int n : kCells)
    for (const MeshData& mesh : {tip, edge})
      for (const double x : {5.0, 5.27})
        for (const double part : {0.9, 1.1}) {
          SCOPED_TRACE(std::to_string(n) + " cells, at " + std::to_string(x) + ", depth " + std::to_string(part));
          expect_verdict(part < 1 ? Verdict::touching : Verdict::penetrating, box({0, 0, 0}, {10, 10, 10}, n),
                         shifted(mesh, x, x, 10 - part * kTolerance), kTolerance);
        }
}

/// Each triangle in n * n, the lowest corner last; coordinates are multiples of n, so that corners stay common.
MeshData cut_finer(const MeshData& mesh, int n) {
  MeshData finer;
  const auto corner_at = [&](std::size_t i, std::size_t axis) { return mesh.xyz[3 * mesh.triangles[i] + axis]; };
  const auto add = [&](std::size_t first, int i, int j) {
    std::size_t lowest = 0;
    for (const std::size_t k : {1, 2})
      if (corner_at(first + k, 2) < corner_at(first + lowest, 2)) lowest = k;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](std::size_t k) { return corner_at(first + (lowest + 1 + k) % 3, axis); };
      finer.xyz.push_back((at(0) * (n - i - j) + at(1) * i + at(2) * j) / n);
    }
    finer.triangles.push_back(static_cast<std::uint32_t>(finer.triangles.size()));
  };
  for (std::size_t first = 0; first < mesh.triangles.size(); first += 3)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(first, i, j), add(first, i + 1, j), add(first, i, j + 1);
        if (i + j + 1 < n) add(first, i + 1, j + 1), add(first, i, j + 1), add(first, i + 1, j);
      }
  return finer;
}

/// Of its triangles, of a few tolerances, one corner is deep; the middle and the other corners are near, or far
/// outside.
TEST(LargeTolerance, OnlyACornerIsDeep) {
  const MeshData octahedron =
      scenes::hull({{0, 0, 0}, {60, 0, 60}, {-60, 0, 60}, {0, 60, 60}, {0, -60, 60}, {0, 0, 120}});
  for (const int n : {1, 2, 3, 4, 5, 6, 10})
    for (const double part : {0.9, 1.1}) {
      SCOPED_TRACE("in " + std::to_string(n) + ", depth " + std::to_string(part));
      const MeshData tip = scaled(cut_finer(octahedron, n), 1.0 / 6, 1.0 / 6, 1.0 / 6);
      expect_verdict(part < 1 ? Verdict::touching : Verdict::penetrating, box({0, 0, 0}, {10, 10, 10}, 5),
                     shifted(tip, 5.2, 5.1, 10 - part * 0.8), 0.8);
    }
}

/// A point and the same point scaled by s are (1 - s) of its distance from the middle apart.
TEST(LargeTolerance, SpheresAreNested) {
  const double flatness = std::cos(std::numbers::pi / 40) * std::cos(std::numbers::pi / 40);  // at least, of the radius
  const MeshData outer = uv_sphere(40, 40, 10);
  const auto inner = [&](double clearance) { return uv_sphere(40, 40, 10 - clearance); };
  for (const double tolerance : {0.2, 0.8, 1.0}) {
    expect_verdict(Verdict::duplicate, outer, inner(0.95 * tolerance), tolerance);
    expect_verdict(Verdict::inside, outer, inner(1.05 * tolerance / flatness), tolerance);
  }
}

/// The ball's radius is more than the cavity's by part of the tolerance.
TEST(LargeTolerance, ABallLiesInACavity) {
  const double flatness = std::cos(std::numbers::pi / 30) * std::cos(std::numbers::pi / 30);
  const MeshData socket = joined(box({-12, -12, -12}, {12, 12, 12}, 8), inverted(uv_sphere(30, 30, 6)));
  for (const double tolerance : {0.2, 0.8}) {
    const auto expect = [&](Verdict verdict, double more) {
      expect_verdict(verdict, socket, uv_sphere(30, 30, 6 + more * tolerance), tolerance);
    };
    expect(Verdict::apart, -1.05 / flatness), expect(Verdict::touching, -0.95), expect(Verdict::touching, 0.95);
    expect(Verdict::penetrating, 1.05 / flatness);
  }
}

/// A large triangle meets hundreds that are small beside the tolerance, and the other way around.
TEST(LargeTolerance, ThroughAPlate) {
  const MeshData plate = box({-20, -20, 0}, {20, 20, 4}),
                 fine = scaled(box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, 24), 4, 4, 4);
  for (const MeshData& bar : {fine, box({-2, -2, 0}, {2, 2, 4})}) {
    expect_verdict(Verdict::penetrating, plate, shifted(bar, 1, 1, 2), 0.3);
    for (const double low : {3.65, -0.35}) expect_verdict(Verdict::penetrating, plate, shifted(bar, 1, 1, low), 0.3);
    for (const double low : {3.75, 4.25}) expect_verdict(Verdict::touching, plate, shifted(bar, 1, 1, low), 0.3);
    for (const double low : {-0.25, 0.0, 0.1}) expect_verdict(Verdict::inside, plate, shifted(bar, 1, 1, low), 0.3);
  }
}

}  // namespace
}  // namespace impinge
