// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Rigid sweeps: against formulas, and against samples of the way.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "impinge/collide.hpp"
#include "impinge/sweeps.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::Random;
using test::mesh_of;
constexpr double kPi = std::numbers::pi;

Pose at(double x, double y, double z) { return {.t = {x, y, z}}; }

/// Turned about the z axis.
Pose turned(double angle, const std::array<double, 3>& t = {}) {
  return {{std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1}, t};
}

std::optional<TimeOfImpact> impact(const Mesh& a, const Sweep& sweep_a, const Mesh& b, const Sweep& sweep_b,
                                   double tolerance) {
  const auto found = time_of_impact(a, sweep_a, b, sweep_b, tolerance);
  EXPECT_TRUE(found) << found.error().message;
  return found ? *found : std::nullopt;
}

/// A bar from the z axis to x = 4, of half width w, that turns about the axis.
constexpr double kHalfWidth = 0.125;
const Mesh& bar() {
  static const Mesh mesh = mesh_of(scenes::box({0, -kHalfWidth, 0}, {4, kHalfWidth, 1}, 3));
  return mesh;
}

/// The bar's side is at the point (x, y) when a line at the distance w from the axis is.
double angle_at(double x, double y) { return std::atan2(y, x) - std::asin(kHalfWidth / std::hypot(x, y)); }

TEST(Sweeps, ATurningBarHitsAPostAtTheAngleOfItsCorner) {
  const double hit = angle_at(0.5, 3);  // of the post's four corners the least
  struct Turn {
    double angle;  ///< in all
    int turns;
    double z0, z1;        ///< of the bar
    double post0, post1;  ///< the post's lowest and highest points
    double expected;      ///< of the angle; below 0: none
  };
  const double full = 2 * kPi;
  const std::vector<Turn> cases{
      {kPi / 2, 0, 0, 0, -1, 2, hit},
      {kPi / 2, 0, 0, 0, 1.5, 2, -1},                     // above it
      {1.25, 0, 0, 0, -1, 2, -1},                         // ends before it
      {kPi / 2 + full, 1, 0, -5, -9, -3.25, hit + full},  // on the way down, in the second turn
      {kPi / 2 + 3 * full, 3, 0, 0, -1, 2, hit},
      // The other way round, by three quarters: mirrored in the plane y z, it begins at half a turn.
      {kPi / 2 - full, -1, 0, 0, -1, 2, kPi + hit},
  };
  for (const Turn& c : cases) {
    SCOPED_TRACE(testing::Message() << "angle " << c.angle << ", from " << c.z0 << " to " << c.z1);
    const Mesh post = mesh_of(scenes::box({-0.5, 3, c.post0}, {0.5, 3.5, c.post1}));
    const Sweep sweep{at(0, 0, c.z0), turned(c.angle, {0, 0, c.z1}), Sweep::Path::screw, c.turns};
    for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
      const auto found = impact(bar(), sweep, post, at_rest({}), tolerance);
      ASSERT_EQ(found.has_value(), c.expected > 0) << tolerance;
      if (!found) continue;
      const double time = c.expected / std::abs(c.angle);
      EXPECT_LE(found->time.lo, time + 1e-12);
      EXPECT_EQ(found->time.lo, found->time.hi);
      // The corner comes nearer by more than half of its way.
      EXPECT_GE(found->time.hi, time - 2 * tolerance / (3 * std::abs(c.angle))) << tolerance;
      EXPECT_LE(found->gap, tolerance);
      // The same seen from the bar.
      const auto swapped = impact(post, at_rest({}), bar(), sweep, tolerance);
      ASSERT_TRUE(swapped);
      EXPECT_LE(swapped->time.lo, time + 1e-12);
      EXPECT_LE(swapped->gap, tolerance);
    }
  }
}

TEST(Sweeps, ACubeFallsOnAPlateWhenItsHeightIsZero) {
  const Mesh cube = mesh_of(scenes::cube()), plate = mesh_of(scenes::box({-4, -4, -1}, {4, 4, 0}));
  for (const auto& [from, to] : {std::array{4.0, -4.0}, {1.0, -2.0}, {3.0, 0.0}, {5.0, 1.0}, {0.0, 3.0}, {0.0, 0.0}}) {
    SCOPED_TRACE(testing::Message() << from << " to " << to);
    Sweep fall{at(0, 0, from), at(0, 0, to), Sweep::Path::straight, 0};
    const bool meets = to <= 0 || from <= 0;
    const double time = from == 0 ? 0 : from / (from - to);
    const auto exact = impact(cube, fall, plate, at_rest({}), 1e-3);
    ASSERT_EQ(exact.has_value(), meets);
    fall.path = Sweep::Path::screw;
    const auto found = impact(cube, fall, plate, at_rest({}), 1e-6);
    ASSERT_EQ(found.has_value(), meets);
    // Both fall, each half of the way.
    const auto both =
        impact(cube, {at(0, 0, from), at(0, 0, from + (to - from) / 2)}, plate, {{}, at(0, 0, (from - to) / 2)}, 1e-6);
    ASSERT_EQ(both.has_value(), meets);
    if (!meets) continue;
    EXPECT_LE(exact->time.lo, time);
    EXPECT_GE(exact->time.hi, time);
    EXPECT_LE(exact->time.hi, std::nextafter(exact->time.lo, 2));
    EXPECT_EQ(exact->gap, 0);
    for (const auto& each : {*found, *both}) {
      EXPECT_LE(each.time.lo, time);
      EXPECT_NEAR(each.time.lo, time, 1e-6);
      EXPECT_LE(each.gap, 1e-6);
    }
    if (from == 0) {
      EXPECT_EQ(found->time.hi, 0);
      EXPECT_EQ(found->gap, 0);
    }
  }
}

/// No vertex is on a face and no edge on an edge there.
TEST(Sweeps, WhatPiercesAtTheStartMeetsThere) {
  const auto triangle = [](const std::array<double, 9>& xyz) {
    return Mesh::create(xyz, std::array<std::uint32_t, 3>{0, 1, 2}).value();
  };
  const Mesh floor = triangle({-10, -10, 0, 10, -10, 0, 0, 10, 0}), wall = triangle({-1, 0, -1, 1, 0, -1, 0, 0, 1});
  for (const double x : {0.0, 0.5, 100.0})
    for (const Sweep::Path path : {Sweep::Path::straight, Sweep::Path::screw}) {
      const auto found = impact(wall, {{}, at(x, 0, 0), path, 0}, floor, at_rest({}), 1e-6);
      ASSERT_TRUE(found) << x;
      EXPECT_EQ(found->time.hi, 0);
      EXPECT_EQ(found->gap, 0);
      EXPECT_NEAR(found->a.z, 0, 1e-12);
    }
}

/// What is within the tolerance at the start, but leaves, has not met; nor has what slides along beyond it.
TEST(Sweeps, WhatLeavesOrSlidesHasNotMet) {
  const Mesh cube = mesh_of(scenes::cube()), plate = mesh_of(scenes::box({-4, -4, -1}, {4, 4, 0}, 5));
  const auto moves = [&](const std::array<double, 3>& way, double tolerance) {
    const Sweep sweep{at(0, 0, 0x1p-10), {.t = {way[0], way[1], 0x1p-10 + way[2]}}};
    return impact(cube, sweep, plate, at_rest({}), tolerance).has_value();
  };
  EXPECT_FALSE(moves({0, 0, 1}, 0x1p-8));
  EXPECT_FALSE(moves({2, 1, 0}, 0x1p-11));
  EXPECT_FALSE(moves({2, 0, 0.5}, 0x1p-11));
  EXPECT_TRUE(moves({2, 1, -0x1p-9}, 0x1p-11));
}

Pose random_pose(Random& random, double size) {
  const auto part = [&] { return random.uniform(-1, 1); };
  return Pose::from_quaternion({part(), part(), part(), part()}, {size * part(), size * part(), size * part()}).value();
}

/// Never later than the first contact of the samples, and near at `hi`.
TEST(Sweeps, NothingTouchesBeforeAndAllIsNearAtTheTime) {
  test::Seeded seeded(20);
  Random& random = seeded.random;
  const std::vector<Mesh> meshes{mesh_of(scenes::torus_knot(2, 3, 40, 5)),
                                 mesh_of(scenes::box({-3, -0.2, -0.2}, {3, 0.2, 0.2}, 2)),
                                 mesh_of(scenes::uv_sphere(12, 8, 1.5)), mesh_of(scenes::cube())};
  int hits = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Mesh &a = meshes[i % 4], &b = meshes[random.integer(0, 3)];
    const auto sweep = [&](bool still, double away) {
      Pose from = random_pose(random, 3), to = random_pose(random, 3);
      from.t[0] += away, to.t[1] += away;
      return still ? at_rest(from) : Sweep{from, to, Sweep::Path::screw, random.integer(-1, 1)};
    };
    const Sweep of_a = sweep(false, 5), of_b = sweep(i % 3 == 0, 0);
    const double tolerance = std::pow(10.0, -random.integer(2, 8));
    const auto found = impact(a, of_a, b, of_b, tolerance);
    const double end = found ? found->time.lo : 1;
    constexpr int kSamples = 150;
    for (int k = 0; k <= kSamples; ++k) {
      const double t = end * k / kSamples;
      if (found && t >= found->time.lo) continue;
      const auto contacts =
          collide(a, pose_at(of_a, t).value(), b, pose_at(of_b, t).value(), {.find = Options::Find::first});
      ASSERT_TRUE(contacts);
      ASSERT_TRUE(contacts->triangles.empty()) << "at " << t << " before " << end;
    }
    (found ? hits : free) += 1;
    if (!found) continue;
    const auto gap = distance(a, pose_at(of_a, found->time.hi).value(), b, pose_at(of_b, found->time.hi).value());
    ASSERT_TRUE(gap);
    EXPECT_LE(gap->distance, tolerance + gap->error);
    EXPECT_NEAR(gap->distance, found->gap, gap->error + 1e-12);
  }
  EXPECT_GT(hits, 15);
  EXPECT_GT(free, 15);
}

TEST(Sweeps, PosesGoOnAScrew) {
  test::Seeded seeded(21);
  Random& random = seeded.random;
  for (int i = 0; i < 50; ++i) {
    const Sweep sweep{random_pose(random, 3), random_pose(random, 3), Sweep::Path::screw, random.integer(-2, 2)};
    EXPECT_EQ(pose_at(sweep, 0).value().R, sweep.from.R);
    EXPECT_EQ(pose_at(sweep, 1).value().t, sweep.to.t);
    // Equal steps are equal motions: pose(t + s) pose(t)⁻¹ is the same for all t.
    const auto step = [&](double t, double s, const Point& x) {
      const Pose from = pose_at(sweep, t).value(), to = pose_at(sweep, t + s).value();
      std::array<double, 3> local{}, world{};
      const std::array<double, 3> p{x.x - from.t[0], x.y - from.t[1], x.z - from.t[2]};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) local[r] += from.R[3 * c + r] * p[c];
      for (std::size_t r = 0; r < 3; ++r) {
        world[r] = to.t[r];
        for (std::size_t c = 0; c < 3; ++c) world[r] += to.R[3 * r + c] * local[c];
      }
      return world;
    };
    const auto first = step(0, 0.25, {1, 2, 3});
    for (const double t : {0.125, 0.5, 0.75}) {
      const auto other = step(t, 0.25, {1, 2, 3});
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(other[k], first[k], 1e-11);
    }
  }
}

TEST(Sweeps, ScalesAndPlacesFarAwayAreTheSame) {
  for (const double scale : {0x1p-200, 0x1p-20, 1.0, 0x1p20, 0x1p200}) {
    SCOPED_TRACE(scale);
    const Mesh small =
        mesh_of(scenes::scaled(scenes::box({0, -kHalfWidth, 0}, {4, kHalfWidth, 1}), scale, scale, scale));
    const Mesh post = mesh_of(scenes::scaled(scenes::box({-0.5, 3, -1}, {0.5, 3.5, 2}), scale, scale, scale));
    const auto found = impact(small, {{}, turned(kPi / 2)}, post, at_rest({}), 1e-6 * scale);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->time.hi, angle_at(0.5, 3) / (kPi / 2), 1e-6);
  }
  // A way of 2^299, of which the last unit is below the tolerance that rounding leaves.
  const Mesh cube = mesh_of(scenes::cube());
  const auto far = impact(cube, {at(-0x1p299, 0, 0), at(0x1p299, 0, 0)}, cube, at_rest({}), 1);
  ASSERT_TRUE(far);
  EXPECT_LE(far->time.lo, 0.5);
  EXPECT_NEAR(far->time.lo, 0.5, 1e-9);
}

TEST(Sweeps, BadInputIsAnError) {
  const Mesh cube = mesh_of(scenes::cube()), none = mesh_of({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Sweep good{{}, at(9, 0, 0)};
  Pose sheared;
  sheared.R[1] = 0.5;
  const auto code = [&](const Mesh& mesh, const Sweep& sweep, double tolerance, const MeasureOptions& options = {}) {
    const auto found = time_of_impact(cube, good, mesh, sweep, tolerance, options);
    EXPECT_FALSE(found);
    return found ? Code{} : found.error().code;
  };
  for (const double tolerance : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(code(cube, good, tolerance), Code::bad_option);
  EXPECT_EQ(code(none, good, 1), Code::bad_mesh);
  EXPECT_EQ(code(cube, {at(nan, 0, 0), {}}, 1), Code::bad_pose);
  EXPECT_EQ(code(cube, {{}, at(nan, 0, 0)}, 1), Code::bad_pose);
  EXPECT_EQ(code(cube, {{}, sheared}, 1), Code::bad_pose);
  EXPECT_EQ(code(cube, {{}, at(0x1p300, 0, 0)}, 1), Code::out_of_range);
  EXPECT_EQ(code(cube, {{}, at(1, 0, 0), Sweep::Path::screw, 1}, 1), Code::bad_option);  // no axis
  EXPECT_EQ(code(cube, {{}, turned(1), Sweep::Path::straight, 1}, 1), Code::bad_option);
  EXPECT_EQ(code(cube, good, 1, {.threads = -1}), Code::bad_option);
  const auto mixed = time_of_impact(cube, {{}, turned(1)}, cube, {at(9, 0, 0), at(5, 0, 0), Sweep::Path::straight}, 1);
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, Code::bad_option);
  for (const double t : {-0.1, 1.1, nan}) EXPECT_FALSE(pose_at(good, t));
  EXPECT_FALSE(pose_at({{}, turned(1), Sweep::Path::straight}, 0.5));
  // A straight path beside a screw that does not turn is exact.
  const auto straight = impact(cube, {at(-3, 0, 0), {}, Sweep::Path::straight}, cube, {at(2, 0, 0), at(1, 0, 0)}, 1);
  ASSERT_TRUE(straight);
  EXPECT_EQ(straight->time.lo, 1);
}

TEST(Sweeps, StopSoonWhenAskedTo) {
  // Knots of 240,000 triangles, of which one turns fifty times beside the other: more than ten seconds.
  const Mesh knot = mesh_of(scenes::torus_knot(2, 3, 4000, 30));
  std::stop_source source;
  const Sweep sweep{{}, turned(3), Sweep::Path::screw, 50};
  std::chrono::steady_clock::time_point asked;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    asked = std::chrono::steady_clock::now();
    source.request_stop();
  });
  const auto found =
      time_of_impact(knot, sweep, knot, {at(0, 0, 6.75), turned(1, {0, 0, 6.75})}, 1e-9, {.stop = source.get_token()});
  const auto ended = std::chrono::steady_clock::now();
  stopper.join();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Code::cancelled);
  EXPECT_LT(ended - asked, std::chrono::seconds(1));  // 0.1 on a machine of its own
}

}  // namespace
}  // namespace impinge
