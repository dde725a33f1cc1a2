// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Doubles on a device spare exact arithmetic, and change no answer.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/gpu/environment.hpp"
#include "tests/pipeline/crowd.hpp"

namespace impinge {
namespace {

/// How many pairs were left to exact arithmetic, in all scenes.
struct Unsure {
  std::uint64_t with = 0, without = 0;
};

class Doubles : public testing::Test {
 protected:
  void SetUp() override {
    if (!gpu::Devices::of_process().choose("").opened->with_doubles) GTEST_SKIP() << "the device has none";
  }

  static Unsure compare(const std::vector<test::NamedScene>& scenes) {
    std::vector<Contacts> expected;
    for (const test::NamedScene& named : scenes)
      expected.push_back(test::scene_of(named.scene).collide({.backend = "paper"}).value());
    std::vector<std::uint64_t> with;
    Unsure unsure;
    for (const bool no_doubles : {false, true}) {
      const test::WithLimits limits({.no_doubles = no_doubles});
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        SCOPED_TRACE(scenes[i].name + (no_doubles ? ", without" : ", with"));
        const auto found = test::scene_of(scenes[i].scene).collide({.backend = "gpu"});
        EXPECT_TRUE(found);
        if (!found) continue;
        EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
        test::expect_same(expected[i], *found);
        const std::uint64_t calls = found->statistics.exact_calls;
        if (no_doubles) {
          EXPECT_LE(with[i], calls);
          unsure.without += calls;
        } else {
          with.push_back(calls);
          unsure.with += calls;
        }
      }
    }
    return unsure;
  }

  static void tell(const std::string& what, const Unsure& unsure) {
    std::cout << what << ": " << unsure.with << " left to exact arithmetic with doubles, " << unsure.without
              << " without\n";
  }
};

TEST_F(Doubles, ChangeNoAnswerOfHardScenes) {
  Unsure all;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::Seeded seeded(seed);
    const Unsure unsure = compare(test::hard_scenes(seeded.random, 40));
    all.with += unsure.with, all.without += unsure.without;
  }
  tell("hard scenes", all);
}

/// On a grid of numbers, so that world coordinates are in the exact domain however small.
TEST_F(Doubles, ChangeNoAnswerAtTheEndsOfTheDomain) {
  test::Seeded seeded(3);
  std::vector<test::NamedScene> all;
  for (const int exponent : {-345, -340, 280})
    for (const double away : {0.0, 1.0, 0x1p15}) {
      const double scale = std::ldexp(1.0, exponent);
      scenes::PlacedScene scene;
      scene.meshes = {scenes::torus_knot_of(600), scenes::integer_soup(seeded.random, 60, 3)};
      for (scenes::MeshData& mesh : scene.meshes)
        for (double& x : mesh.xyz) x = scale * (std::round(x * 0x1p10) * 0x1p-10 + away);
      scene.objects = {{.mesh = 0}, {.mesh = 1}, {.mesh = 0, .pose = {.t = {0.125 * scale, -0.25 * scale, 0}}}};
      all.push_back({"2^" + std::to_string(exponent) + ", moved by " + std::to_string(away), scene});
    }
  tell("ends of the domain", compare(all));
}

TEST_F(Doubles, LeaveNextToNothingInGeneralPosition) {
  test::Seeded seeded(4);
  std::vector<test::NamedScene> near, far;
  for (int i = 0; i < 8; ++i) {
    scenes::PlacedScene scene;
    scene.meshes = {scenes::torus_knot_of(4000), scenes::torus_knot_of(2000)};
    scene.objects = {{.mesh = 0, .pose = scenes::random_motion(seeded.random, 0.5)},
                     {.mesh = 1, .pose = scenes::random_motion(seeded.random, 0.5)},
                     {.mesh = 0, .pose = scenes::random_motion(seeded.random, 0.5)}};
    near.push_back({"knots " + std::to_string(i), scene});
    for (scenes::PlacedObject& object : scene.objects) object.pose.t[0] += 1e6, object.pose.t[1] -= 1e6;
    far.push_back({"far knots " + std::to_string(i), scene});
  }
  const Unsure of_near = compare(near), of_far = compare(far);
  tell("knots", of_near), tell("knots at 1e6", of_far);
  EXPECT_LT(of_near.with, 3u);
  EXPECT_LT(of_far.with, of_far.without);
}

}  // namespace
}  // namespace impinge
