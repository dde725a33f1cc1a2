// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "impinge/collide.hpp"
#include "impinge/impacts.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::Random;

Step step_of(Result<Step> result) {
  EXPECT_TRUE(result) << result.error().message;
  return *std::move(result);
}

bool meets_itself(const Mesh& mesh) { return !self_collide(mesh)->triangles.empty(); }
bool touch(const Mesh& a, const Mesh& b) { return !collide(a, {}, b, {})->triangles.empty(); }

const MotionOptions kOneThread{.threads = 1};

/// The first impact of one mesh with itself, of the other with itself, and of both.
std::optional<Interval> first_of(const Moving& a, const Moving& b) {
  std::optional<Interval> first;
  for (const auto& impacts : {find_impacts(a, kOneThread), find_impacts(b, kOneThread), find_impacts(a, b, kOneThread)})
    if (impacts->earliest && (!first || impacts->earliest->lo < first->lo)) first = impacts->earliest;
  return first;
}

Mesh mapped(const Mesh& mesh, const auto& move) {
  std::vector<double> xyz;
  for (const Point& p : mesh.vertices()) {
    const Point q = move(p);
    xyz.insert(xyz.end(), {q.x, q.y, q.z});
  }
  return *mesh.deformed(xyz);
}

/// Each vertex is pushed by chance, and towards the middle.
Mesh pushed(Random& random, const Mesh& mesh, double pull, double chance) {
  return mapped(mesh, [&](const Point& p) {
    const auto one = [&](double x) { return x - pull * x + random.uniform(-chance, chance); };
    return Point{one(p.x), one(p.y), one(p.z)};
  });
}

TEST(CollisionFreeStep, LeavesEverythingApartStepAfterStep) {
  test::Seeded seeded(20271);
  int cut = 0, rounded = 0;
  for (int run = 0; run < 40; ++run) {
    Mesh a = mapped(test::mesh_of(scenes::flat_grid(2, 2, 0.5)), [](const Point& p) {
      return Point{p.x - 0.5, p.y - 0.5, 0.25};
    });
    Mesh b = mapped(a, [](const Point& p) { return Point{p.y, p.x, -p.z}; });
    for (int i = 0; i < 250; ++i) {
      const double pull = i % 5 == 4 ? -0.1 : 0.1, chance = std::ldexp(1.0, -2 - i % 7);
      const Moving first{a, pushed(seeded.random, a, pull, chance)}, second{b, pushed(seeded.random, b, pull, chance)};
      const std::optional<Interval> impact = first_of(first, second);
      const Step step = step_of(collision_free_step(std::array{first, second}, kOneThread));
      ASSERT_EQ(step.ends.size(), 2u);
      ASSERT_FALSE(first_of({a, step.ends[0]}, {b, step.ends[1]}));
      a = step.ends[0], b = step.ends[1];
      ASSERT_FALSE(meets_itself(a) || meets_itself(b) || touch(a, b)) << "step " << i << " of run " << run;
      if (!impact) {
        EXPECT_EQ(step.time, 1);
        EXPECT_TRUE(std::ranges::equal(a.vertices(), first.to.vertices()));
        continue;
      }
      ++cut;
      EXPECT_LT(step.time, impact->lo);
      if (step.time >= (1 - 0x1p-10) * impact->lo) continue;
      // Vertices move by less than 2 and are rounded by 2^-52 at most. That only counts where less than a thousandth of
      // the way to the impact is left and this is so short, or where features pass each other almost in parallel.
      ++rounded;
      EXPECT_LT(impact->lo, 0x1p-20) << step.time;
    }
  }
  EXPECT_GT(cut, 1000);
  EXPECT_GT(rounded, 10);
}

TEST(CollisionFreeStep, KeepsWhatIsTheSameAtBothEnds) {
  // A triangle whose first corner is pinned falls onto a still floor; 0.1 + 0.2 and the like do not come back exactly.
  const std::vector<std::uint32_t> triangle{0, 1, 2};
  const auto at = [&](double z) {
    return *Mesh::create(std::vector<double>{0.1, 0.7, 0.3, 1.1, 0.2, z, 0.3, 1.3, z}, triangle);
  };
  const Mesh floor = test::mesh_of(scenes::flat_grid(4, 4)), low = at(-1.7), high = at(0.9);
  const Step step = step_of(collision_free_step(std::array<Moving, 2>{{{high, low}, {floor, floor}}}));
  // At z = 0 after 0.9 / 2.6 of the way.
  EXPECT_LT(step.time, 0.9 / 2.6);
  EXPECT_GT(step.time, (1 - 0x1p-10) * 0.9 / 2.6 - 0x1p-50);
  EXPECT_EQ(step.ends[0].vertices()[0], high.vertices()[0]);
  EXPECT_EQ(&step.ends[1].state(), &floor.state());
  for (std::size_t i : {1, 2}) {
    const double t = step.time;
    EXPECT_EQ(step.ends[0].vertices()[i].z, (1 - t) * 0.9 + t * -1.7);
    EXPECT_EQ(step.ends[0].vertices()[i].x, high.vertices()[i].x);
  }
  // Until a time before that, and nothing at all.
  EXPECT_EQ(step_of(collision_free_step(std::array<Moving, 2>{{{high, low}, {floor, floor}}}, {.end = 0.25})).time,
            0.25);
  EXPECT_EQ(step_of(collision_free_step(std::array<Moving, 1>{{{high, low}}}, {.end = 0})).ends[0].vertices()[1],
            high.vertices()[1]);
  EXPECT_TRUE(step_of(collision_free_step({})).ends.empty());
  for (const double end : {0.1, 0.3, 0.6, 0.7, 0.9}) {
    const Step part = step_of(collision_free_step(std::array<Moving, 1>{{{high, low}}}, {.end = end}));
    EXPECT_EQ(part.time, end);
    EXPECT_EQ(part.ends[0].vertices()[0], high.vertices()[0]);
  }
}

TEST(CollisionFreeStep, WorksAtBothEndsOfTheRange) {
  const Mesh unit = test::mesh_of(scenes::cube());
  for (const double scale : {0x1p-290, 1.0, 0x1p290}) {
    const auto at = [&](double x) {
      return mapped(unit, [&](const Point& p) { return Point{scale * (p.x + x), scale * p.y, scale * p.z}; });
    };
    const Step step = step_of(collision_free_step(std::array<Moving, 2>{{{at(0), at(4)}, {at(3), at(3)}}}));
    EXPECT_LE(step.time, 0.5);
    EXPECT_GE(step.time, 0.5 * (1 - 0x1p-10));
    // The lowest corner alone goes out to 2^300: away, or through the cube.
    const Mesh cube = at(0);
    for (const double z : {-1.0, 1.0}) {
      const Mesh far = mapped(cube, [&](const Point& p) {
        return p == Point{0, 0, 0} ? Point{0, 0, std::copysign(0x1p300, z)} : p;
      });
      const Step alone = step_of(collision_free_step(std::array<Moving, 1>{{{cube, far}}}));
      EXPECT_EQ(alone.time == 1, z < 0) << scale;
      EXPECT_FALSE(find_impacts(Moving{cube, alone.ends[0]})->earliest);
    }
  }
}

TEST(CollisionFreeStep, SaysWhatIsWrong) {
  const auto fails = [](const Result<Step>& result, Code code, const std::string& words) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  const Mesh cube = test::mesh_of(scenes::cube()), fine = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 2));
  const auto at = [&](double x) { return mapped(cube, [&](const Point& p) { return Point{p.x + x, p.y, p.z}; }); };
  fails(collision_free_step(std::array<Moving, 2>{{{cube, cube}, {cube, fine}}}), Code::bad_mesh,
        "mesh 1 has 8 vertices");
  fails(collision_free_step({}, {.end = -1}), Code::bad_option, "0 to 1");
  fails(collision_free_step(std::array<Moving, 2>{{{cube, cube}, {at(1), at(2)}}}), Code::in_contact,
        "meshes 0 and 1 touch");
  // Two cubes in one mesh, one in the other.
  scenes::MeshData two = scenes::cube();
  const scenes::MeshData second = scenes::shifted(scenes::cube(), 0.5, 0.25, 0.125);
  two.xyz.insert(two.xyz.end(), second.xyz.begin(), second.xyz.end());
  for (const std::uint32_t v : second.triangles) two.triangles.push_back(v + 8);
  const Mesh crossed = test::mesh_of(two), lifted = mapped(crossed, [](const Point&p) {
                                             return Point{p.x, p.y, p.z + 1};
                                           });
  fails(collision_free_step(std::array<Moving, 1>{{{crossed, lifted}}}), Code::in_contact, "mesh 0 touches itself");
  // What stands still is left as it is, and does not disturb.
  const Step still = step_of(collision_free_step(std::array<Moving, 2>{{{crossed, crossed}, {at(9), at(2)}}}));
  EXPECT_EQ(still.time, 1);
  const Mesh empty = test::mesh_of({});
  EXPECT_EQ(step_of(collision_free_step(std::array<Moving, 2>{{{empty, empty}, {at(0), at(1)}}})).time, 1);
  std::stop_source stop;
  stop.request_stop();
  fails(collision_free_step(std::array<Moving, 1>{{{fine, mapped(fine,
                                                                 [](const Point& p) {
                                                                   return Point{p.x, p.y, -p.z};
                                                                 })}}},
                            {.stop = stop.get_token()}),
        Code::cancelled, "stopped");
}

TEST(CollisionFreeStep, StopsSoonWhenAskedTo) {
  // Sheets of 20,000 triangles that fall through each other almost in parallel, which would take some seconds.
  test::Seeded seeded(20272);
  const auto sheet = [&](double z) {
    return test::mesh_of(
        scenes::grid(100, 100, 0.01, [&](int, int) { return z + seeded.random.uniform(-0.01, 0.01); }));
  };
  const std::array<Moving, 2> meshes{{{sheet(1), sheet(-1)}, {sheet(-1), sheet(1)}}};
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  std::jthread asking([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  const auto result = collision_free_step(meshes, {.threads = 1, .stop = stop.get_token()});
  const auto ended = std::chrono::steady_clock::now();
  asking.join();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Code::cancelled);
  EXPECT_LT(ended - asked, std::chrono::seconds(1));  // 0.1 on a machine of its own
}

}  // namespace
}  // namespace impinge
