// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/grid_names.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace impinge::report {
namespace {

using Strings = std::vector<std::string_view>;

/// In a plan that is turned by `angle` about (x, y).
struct Turned {
  double x = 0, y = 0, angle = 0;
  [[nodiscard]] Point at(double u, double v) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {x + c * u - s * v, y + s * u + c * v, 7};
  }
};

/// Axes A, B... where v is one of the numbers, and 1, 2... where u is, 5 longer than the outermost crossings.
io::Grid rectangular(const Turned& plan, const std::vector<double>& v, const std::vector<double>& u,
                     const std::string& storey = "") {
  io::Grid grid{"Grid", storey, {}};
  for (std::size_t i = 0; i < v.size(); ++i)
    grid.axes.push_back(
        {std::string(1, static_cast<char>('A' + i)), 1, {plan.at(u.front() - 5, v[i]), plan.at(u.back() + 5, v[i])}});
  for (std::size_t i = 0; i < u.size(); ++i)
    grid.axes.push_back({std::to_string(i + 1), 0, {plan.at(u[i], v.back() + 5), plan.at(u[i], v.front() - 5)}});
  return grid;
}

/// The number whose half bays the coordinate is in, or -1; NaN where that is a matter of rounding.
double nearest(const std::vector<double>& axes, double at) {
  constexpr double kNear = 1e-6;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double before = (i > 0 ? axes[i] - axes[i - 1] : axes[1] - axes[0]) / 2;
    const double after = (i + 1 < axes.size() ? axes[i + 1] - axes[i] : before * 2) / 2;
    for (const double edge : {axes[i] - before, axes[i] + after})
      if (std::abs(edge - at) < kNear) return std::nan("");
    if (at > axes[i] - before && at < axes[i] + after) return static_cast<double>(i);
  }
  return -1;
}

TEST(GridNames, HalfABayAroundEachCrossing) {
  std::mt19937 random(7);
  const std::vector<double> v{0, 6, 13, 20}, u{-3, 2, 10, 14, 22};
  for (const Turned& plan : {Turned{}, Turned{5e6, -3e6, 0.7}, Turned{10, 20, 2}})
    for (const bool y_up : {false, true}) {
      io::Grid grid = rectangular(plan, v, u);
      const auto stood = [&](Point p) { return y_up ? Point{p.x, p.z, p.y} : p; };
      for (io::GridAxis& axis : grid.axes)
        for (Point& p : axis.points) p = stood(p);
      const GridNames names(std::vector{grid}, y_up);
      for (int i = 0; i < 2000; ++i) {
        const double at_u = std::uniform_real_distribution(-12., 32.)(random);
        const double at_v = std::uniform_real_distribution(-10., 30.)(random);
        const double column = nearest(u, at_u), row = nearest(v, at_v);
        if (std::isnan(column + row)) continue;
        std::string expected;
        if (column >= 0 && row >= 0)
          expected = std::string(1, static_cast<char>('A' + static_cast<int>(row))) + "/" +
                     std::to_string(static_cast<int>(column) + 1);
        ASSERT_EQ(names.name_at(stood(plan.at(at_u, at_v)), Strings{}), expected) << at_u << " " << at_v;
      }
    }
}

TEST(GridNames, OfARadialGrid) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto polar = [](double r, double degrees) {
    return Point{1000 + r * std::cos(degrees * kDegree), 500 + r * std::sin(degrees * kDegree), 0};
  };
  io::Grid grid{"Rotunda", "", {}};
  for (int ring = 1; ring <= 3; ++ring) {
    io::GridAxis& axis = grid.axes.emplace_back(io::GridAxis{"R" + std::to_string(ring), 0, {}});
    for (int i = 0; i <= 240; ++i) axis.points.push_back(polar(10 * ring, -10 + i * (140. / 240)));
  }
  for (int ray = 0; ray < 5; ++ray)
    grid.axes.push_back({std::to_string(ray + 1), 1, {polar(0, 0), polar(40, 30 * ray)}});
  const GridNames names(std::vector{grid}, false);
  for (const auto& [r, degrees, expected] : {std::tuple(19., 31., "R2/2"),
                                             {10., 0., "R1/1"},
                                             {14., 44., "R1/2"},
                                             {16., 46., "R2/3"},
                                             {34., 120., "R3/5"},
                                             {36., 60., ""},  // half a bay beyond the last ring is 35
                                             {20., -14., "R2/1"},
                                             {20., -17., ""},  // half a bay beyond the first ray: 5.18 / 20
                                             {20., 210., ""},  // straight across from the second ray
                                             {6., 90., "R1/4"},
                                             {4., 90., ""}})
    EXPECT_EQ(names.name_at(polar(r, degrees), Strings{}), expected) << r << " at " << degrees;
}

TEST(GridNames, WithoutATagOrAnAxisToCrossThereIsNone) {
  io::Grid grid = rectangular({}, {0, 6, 12}, {0, 8, 16});
  grid.axes[1].tag.clear();
  const GridNames names(std::vector{grid}, false);
  EXPECT_EQ(names.name_at({8, 1, 0}, Strings{}), "A/2");
  EXPECT_EQ(names.name_at({8, 5, 0}, Strings{}), "") << "nearest to the axis between A and C";
  EXPECT_EQ(names.name_at({8, 11, 0}, Strings{}), "C/2");
  // One axis a way: its bay is as long as that of the axes across.
  const GridNames single(std::vector{rectangular({}, {0}, {0, 8, 16})}, false);
  EXPECT_EQ(single.name_at({9, 3.9, 0}, Strings{}), "A/2");
  EXPECT_EQ(single.name_at({9, 4.1, 0}, Strings{}), "");
  EXPECT_EQ(GridNames(std::vector{rectangular({}, {0}, {0})}, false).name_at({0, 0, 0}, Strings{}), "");
  io::Grid one_way = rectangular({}, {0}, {0, 8});
  one_way.axes.erase(one_way.axes.begin());
  EXPECT_EQ(GridNames(std::vector{one_way}, false).name_at({0, 0, 0}, Strings{}), "");
  EXPECT_EQ(GridNames(std::vector<io::Grid>{}, false).name_at({0, 0, 0}, Strings{}), "");
}

TEST(GridNames, WhereAnAxisIsDrawnTwice) {
  // The second one once more, the other way round, with what rounding may add.
  for (const double by : {0., 1e-9, -1e-9})
    for (const std::vector<double>& u : {std::vector<double>{0, 10}, {10, 20}, {0, 10, 20}}) {
      io::Grid grid = rectangular({}, {0, 6}, u);
      const auto name = [](double at) { return at == 0 ? "1" : at == 10 ? "2" : "3"; };
      for (std::size_t i = 0; i < u.size(); ++i) grid.axes[2 + i].tag = name(u[i]);
      grid.axes.push_back({"2", 0, {{10 + by, -5, 0}, {10 + by, 11, 0}}});
      const GridNames names(std::vector{grid}, false);
      for (const double x : {-100000., -5.1, -4.9, 0., 4.9, 5.1, 9., 11., 14.9, 15.1, 24.9, 25.1, 100000.}) {
        const double row = std::nearbyint(x / 10) * 10;
        const bool is_by_one = std::ranges::find(u, row) != u.end();
        EXPECT_EQ(names.name_at({x, 1, 0}, Strings{}), is_by_one ? std::string("A/") + name(row) : "") << x;
      }
    }
}

TEST(GridNames, AreNoneOfAGridWhoseAxesCrossTooOften) {
  // A zigzag about the axis A, and the axis itself.
  const auto zigzag = [](int crossings) {
    io::Grid grid{"Zigzag", "", {{"A", 1, {{0, 0, 0}, {400, 0, 0}}}, {"1", 0, {}}}};
    for (int i = 0; i <= crossings; ++i) grid.axes[1].points.push_back({10. * i, i % 2 == 0 ? -5. : 5., 0});
    return grid;
  };
  const GridNames most(std::vector{zigzag(16)}, false), more(std::vector{zigzag(17), zigzag(1)}, false);
  EXPECT_EQ(most.name_at({155, 1, 0}, Strings{}), "A/1");
  EXPECT_EQ(most.warnings(), std::vector<std::string>{});
  EXPECT_EQ(more.name_at({155, 1, 0}, Strings{}), "");
  EXPECT_EQ(more.warnings(),
            std::vector<std::string>{"no axes are named by the grid 'Zigzag': two of them cross more than 16 times"});
}

TEST(GridNames, OfTheStoreyOrElseOfTheBuildingOrElseWhereAllStoreysAgree) {
  const auto shifted = [](double by, const std::string& storey) {
    return rectangular({by, by, 0}, {0, 6, 12}, {0, 6, 12}, storey);
  };
  const Point at{5.9, 5.9, 0};
  const GridNames both(std::vector{shifted(0, ""), shifted(6, "Level 1")}, false);
  EXPECT_EQ(both.name_at(at, Strings{"Level 1"}), "A/1");
  EXPECT_EQ(both.name_at(at, Strings{"Level 2"}), "B/2");
  EXPECT_EQ(both.name_at({0, 0, 0}, Strings{"Level 1"}), "A/1") << "beyond the storey's grid the building's holds";
  const GridNames storeys(std::vector{shifted(0, "Level 1"), shifted(6, "Level 2")}, false);
  EXPECT_EQ(storeys.name_at(at, Strings{"Level 1", "Level 2"}), "B/2") << "between the axes of Level 1";
  EXPECT_EQ(storeys.name_at(at, Strings{"Level 3"}), "") << "two names";
  EXPECT_EQ(storeys.name_at({0, 0, 0}, Strings{"Level 2"}), "");
  EXPECT_EQ(GridNames(std::vector{shifted(0, "Level 1"), shifted(0, "Level 2")}, false).name_at(at, Strings{}), "B/2");
  // Of two wings the one that the place is between the axes of.
  const GridNames wings(std::vector{rectangular({}, {0, 20}, {0, 20}), rectangular({23, 8, 0}, {0, 8}, {0, 8})}, false);
  EXPECT_EQ(wings.name_at({19.5, 9, 0}, Strings{}), "A/2");
}

}  // namespace
}  // namespace impinge::report
