// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

namespace impinge {
namespace {

using partition::Cells;
using partition::Grid;

/// Few values, so that borders coincide, each perhaps an ulp or two off.
rc::Gen<double> coordinate() {
  return rc::gen::map(rc::gen::pair(rc::gen::inRange(-4, 5), rc::gen::inRange(-2, 3)),
                      [](const std::pair<int, int>& p) {
                        double x = p.first / 3.0;
                        for (int i = 0; i < p.second; ++i) x = std::nextafter(x, 9.0);
                        for (int i = 0; i > p.second; --i) x = std::nextafter(x, -9.0);
                        return x;
                      });
}

Box any_box() {
  const auto vec = [] {
    const double x = *coordinate(), y = *coordinate();
    return Vec3{x, y, *coordinate()};
  };
  const Vec3 p = vec(), q = vec();
  return {min(p, q), max(p, q)};
}

void check_sharing(const Grid& grid, const Box& region, const Box& a, const Box& b) {
  const Cells in_a = grid.cells_of(a), in_b = grid.cells_of(b);
  RC_ASSERT((in_a != 0) == overlap(a, region));
  RC_ASSERT((in_b != 0) == overlap(b, region));
  const Box common = intersection(a, b);
  if (!is_empty(common) && overlap(common, region)) RC_ASSERT((in_a & in_b) != 0);
}

RC_GTEST_PROP(Grid, BoxesThatMeetWithinTheRegionShareACell, ()) {
  const Box region = any_box();
  const double size = *rc::gen::element(0.0, 1e-300, 0.01, 0.1, 1.0 / 3, 1.0, 100.0);
  const Grid grid(region, {size, *rc::gen::element(0.0, 0.07, 1.0), *rc::gen::element(0.0, 0.2, 1.0)});
  check_sharing(grid, region, any_box(), any_box());
}

RC_GTEST_PROP(Grid, BoxesThatMeetShareACellAtEveryScale, ()) {
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-350, 298)), offset = *rc::gen::element(0.0, 1.0, 1e6, 1e12);
  const auto moved = [&](const Box& box) {
    const auto move = [&](const Vec3& v) { return scale * (v + Vec3{offset, -offset, offset}); };
    return Box{move(box.lo), move(box.hi)};
  };
  const Box region = moved(any_box());
  const Grid grid(region, (scale * *rc::gen::element(0.03, 0.3, 3.0)) * Vec3{1, 2, 0.5});
  check_sharing(grid, region, moved(any_box()), moved(any_box()));
}

TEST(Grid, PartsWhatLiesFarApart) {
  const Grid grid({{0, 0, 0}, {4, 4, 4}}, {1, 1, 1});
  const auto cell = [&](double x, double y, double z) { return grid.cells_of({{x, y, z}, {x, y, z}}); };
  Cells all = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const Cells one = cell(i + 0.5, j + 0.5, k + 0.5);
        EXPECT_EQ(std::popcount(one), 1);
        EXPECT_EQ(all & one, 0u);
        all |= one;
      }
  EXPECT_EQ(all, ~Cells{0});
  EXPECT_EQ(grid.cells_of({{0, 0, 0}, {4, 4, 4}}), ~Cells{0});
  EXPECT_EQ(std::popcount(grid.cells_of({{0.5, 0.5, 0.5}, {1.5, 0.5, 2.5}})), 2 * 1 * 3);
  EXPECT_EQ(cell(4.0000001, 0, 0), 0u);
}

TEST(Grid, OfARegionWithoutExtentIsOneCell) {
  const Grid grid({{1, 2, 3}, {1, 2, 3}}, {0, 0, 0});
  EXPECT_EQ(std::popcount(grid.cells_of({{0, 0, 0}, {9, 9, 9}})), 1);
  EXPECT_EQ(grid.cells_of({{0, 0, 0}, {0.9, 9, 9}}), 0u);
}

}  // namespace
}  // namespace impinge
