// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The borders of the range in which every answer is exact, and callers with another floating-point environment.
#include <fenv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "expected.hpp"
#include "impinge/collide.hpp"
#include "impinge/scene.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/oracle/points.hpp"
#include "tests/oracle/rational.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::PlacedScene;
using scenes::Random;

constexpr double kSmallest = 0x1p-358;
const double kLargest = std::nextafter(0x1p300, 0.0);

/// Triangles whose coordinates are borders of the domain, of either sign, and numbers between them.
MeshData border_soup(Random& random, int n) {
  const std::array<double, 7> values{0, kSmallest, 3 * kSmallest, 1, 0x1p299, kLargest, 0x1.fffffffffffffp-306};
  MeshData mesh;
  for (int i = 0; i < n; ++i) {
    std::array<double, 9> corners{};
    for (double& x : corners)
      x = values[static_cast<std::size_t>(random.integer(0, 6))] * (random.integer(0, 1) == 0 ? 1 : -1);
    mesh.add_triangle(corners);
  }
  return mesh;
}

TEST(Domain, IsExactAtItsBorders) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const MeshData a = scenes::integer_soup(random, 80, 3);
    const MeshData b = scenes::integer_soup(random, 80, 3);
    const expected::Set set = expected::expect_exact(scenes::pair_scene(a, b));
    for (const double scale : {kSmallest, 0x1p-300, 0x1p-200, 0x1p100, 0x1p200, 0x1p298}) {
      SCOPED_TRACE(scale);
      expected::expect_finds(
          set, scenes::pair_scene(scenes::scaled(a, scale, scale, scale), scenes::scaled(b, scale, scale, scale)));
    }
    for (const auto& [x, y, z] : {std::array{0x1p298, 1.0, kSmallest}, std::array{kSmallest, 0x1p298, 0x1p298},
                                  std::array{1.0, kSmallest, kSmallest}}) {
      expected::expect_finds(set, scenes::pair_scene(scenes::scaled(a, x, y, z), scenes::scaled(b, x, y, z)));
    }
    const MeshData border_a = border_soup(random, 80);
    const MeshData border_b = border_soup(random, 80);
    EXPECT_FALSE(expected::expect_exact(scenes::pair_scene(border_a, border_b)).empty());
    expected::expect_exact(scenes::pair_scene(border_a, border_a));
  }
}

TEST(Domain, IsExactInMotionNearItsBorders) {
  Random random(11);
  for (const double scale : {0x1p-240, 0x1p290}) {
    PlacedScene scene =
        scenes::shifted_pair(scenes::scaled(scenes::bumpy_grid(6, 6), scale, scale, scale), {scale, 0, 0});
    for (auto& object : scene.objects) object.pose.R = scenes::random_rotation(random);
    expected::expect_exact(scene);
    expected::expect_exact(scenes::moved(scenes::shifted_pair(scene.meshes[0], {scale, 0, 0}),
                                         {.R = scenes::random_rotation(random), .t = {scale, scale, -scale}}));
  }
}

/// What `collide` and `Scene` say of two meshes.
void expect_out_of_range(const PlacedScene& scene) {
  const std::vector<Mesh> meshes = test::meshes_of(scene);
  for (const auto& answer :
       {collide(meshes[0], scene.objects[0].pose, meshes[1], scene.objects[1].pose), test::scene_of(scene).collide()}) {
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, Code::out_of_range) << answer.error().message;
    EXPECT_FALSE(answer.error().message.empty());
  }
}

/// The cube, one corner's x replaced.
PlacedScene cubes_with_corner(double x) {
  MeshData mesh = scenes::cube();
  mesh.xyz[0] = x;
  return scenes::pair_scene(mesh, scenes::cube());
}

TEST(Domain, RefusesWhatLiesOutside) {
  for (const double x : {0x1p300, -0x1p300, 0x1p1000}) {
    SCOPED_TRACE(x);
    expect_out_of_range(cubes_with_corner(x));
  }
  const MeshData speck = scenes::scaled(scenes::cube(), 0x1p-400, 0x1p-400, 0x1p-400);
  expect_out_of_range(scenes::pair_scene(speck, speck));
  for (const double x : {kLargest, -kLargest, kSmallest, -kSmallest}) {
    SCOPED_TRACE(x);
    EXPECT_FALSE(expected::expect_exact(cubes_with_corner(x)).empty());
  }
}

/// Every triangle against every other, by rationals.
expected::Set by_plain_rationals(const PlacedScene& scene) {
  std::vector<std::vector<oracle::Corners>> triangles;
  const std::vector<Mesh> meshes = test::meshes_of(scene);
  for (const auto& object : scene.objects) {
    triangles.emplace_back();
    for (const Triangle& t : test::world_triangles(meshes[object.mesh], object.pose))
      triangles.back().push_back(points::exact_corners(t));
  }
  expected::Set set;
  for (std::uint32_t a = 0; a < triangles[0].size(); ++a)
    for (std::uint32_t b = 0; b < triangles[1].size(); ++b)
      if (const auto meeting = oracle::meeting(triangles[0][a], triangles[1][b]))
        set.push_back({0, 1, a, b, static_cast<std::uint32_t>(*meeting)});
  return set;
}

/// Positions that are smoothed towards 0, and coordinates as small beside others: the answer is that of rationals, in
/// all ways, and it is not that of 0.
TEST(Domain, HoldsNumbersHoweverNearToZero) {
  const double least = std::numeric_limits<double>::denorm_min();
  Random random(13);
  int others = 0;
  const auto expect_by_rationals = [&](const PlacedScene& scene) {
    const expected::Set set = by_plain_rationals(scene);
    expected::expect_finds(set, scene);
    EXPECT_EQ(test::scene_of(scene).touches_any().value(), !set.empty());
    return set;
  };
  for (const double x : {least, -least, 1e-320, -0x1p-1030, 7e-93, -1e-100, 0x1p-359}) {
    SCOPED_TRACE(x);
    PlacedScene flush = scenes::cube_pair({1, 0, 0});
    for (const std::array<double, 3>& t : {std::array{x, 0.0, 0.0}, {0.0, x, -x}, {x, x, x}}) {
      const expected::Set at_rest = by_plain_rationals(flush);
      PlacedScene moved = flush;
      moved.objects[0].pose.t = t;
      others += expect_by_rationals(moved) != at_rest;
    }
    PlacedScene turned = scenes::shifted_pair(scenes::bumpy_grid(2, 2), {0.5, 0, 0});
    turned.objects[0].pose = {.R = scenes::random_rotation(random), .t = {x, -x, x}};
    turned.objects[1].pose.R = turned.objects[0].pose.R;
    expect_by_rationals(turned);
    EXPECT_FALSE(expect_by_rationals(cubes_with_corner(x)).empty());
  }
  EXPECT_GT(others, 5);
  for (int i = 0; i < 3; ++i) {
    const auto soup = [&] {
      MeshData mesh = scenes::integer_soup(random, 24, 2);
      for (double& y : mesh.xyz)
        if (random.integer(0, 2) == 0) y = std::ldexp(random.integer(-2, 2), -random.integer(350, 1074));
      return mesh;
    };
    EXPECT_FALSE(expect_by_rationals(scenes::pair_scene(soup(), soup())).empty());
    // All of it but for one coordinate is next to nothing.
    const auto speck = [&] {
      MeshData mesh = soup();
      for (std::size_t k = 0; k < mesh.xyz.size(); ++k)
        mesh.xyz[k] = k % 3 == 0 ? 1 : std::ldexp(random.integer(-2, 2), -1074 + i * 350);
      return mesh;
    };
    EXPECT_FALSE(expect_by_rationals(scenes::pair_scene(speck(), speck())).empty());
    expect_by_rationals(scenes::pair_scene(speck(), soup()));
  }
}

TEST(Domain, CountsThePose) {
  PlacedScene scene = cubes_with_corner(0x1p299);
  scene.objects[0].pose.t = {0x1p299, 0, 0};
  expect_out_of_range(scene);
  scene.objects[0].pose.t = {-0x1p299, 0, 0};
  expected::expect_exact(scene);
  // A turn that takes (x, x, 0) further out than x.
  MeshData far = scenes::scaled(scenes::cube(), 0x1.8p299, 0x1.8p299, 1);
  PlacedScene turned = scenes::pair_scene(far, far);
  turned.objects[0].pose.R = {0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1};
  expect_out_of_range(turned);
}

struct Answer {
  Result<Contacts> contacts;
  bool unchanged;
};

/// Makes meshes, scene and query in the caller's environment. `collide` on the first two objects where `pair` is set.
Answer answer_under(const PlacedScene& scene, int rounding, bool flush, bool pair, const Options& options = {}) {
  const test::CallersMode mode(rounding, flush);
  const auto ask = [&]() -> Result<Contacts> {
    if (!pair) {
      Scene placed = test::scene_of(scene);
      EXPECT_TRUE(placed.update());
      return placed.collide(options);
    }
    const std::vector<Mesh> meshes = test::meshes_of(scene);
    const auto &a = scene.objects[0], &b = scene.objects[1];
    return collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, options);
  };
  Result<Contacts> contacts = ask();
  return {std::move(contacts), mode.is_untouched()};
}

TEST(Environment, OfTheCallerChangesNoAnswerAndIsRestored) {
  Random random(3);
  const auto motion = scenes::random_motion(random, 10);
  const MeshData soup = scenes::integer_soup(random, 60, 2);
  const MeshData tiny = scenes::scaled(soup, kSmallest, kSmallest, kSmallest);
  MeshData denormal = scenes::cube();  // coordinates that only count once the pose has moved them: to nothing
  for (double& x : denormal.xyz) x = x == 0 ? 0x1p-1060 : x;
  PlacedScene vanishing = scenes::pair_scene(denormal, scenes::cube());
  vanishing.objects[0].pose.t = {1, 1, 1};
  const std::vector<PlacedScene> all{
      scenes::moved(scenes::t_junctions(3), motion),
      scenes::moved(scenes::cube_pair({1, 0, 0}), motion),
      scenes::moved(scenes::shifted_pair(scenes::bumpy_grid(8, 8), {0.5, 0, 0}), motion),
      scenes::moved(scenes::pair_scene(soup, soup), motion),
      scenes::pair_scene(tiny, tiny),
      scenes::pair_scene(border_soup(random, 60), border_soup(random, 60)),
      vanishing,
  };
  for (const PlacedScene& scene : all) {
    const expected::Set set = expected::expect_exact(scene);
    EXPECT_FALSE(set.empty());
    for (const int rounding : {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO})
      for (const bool flush : {false, true}) {
        for (const bool pair : {false, true})
          for (const char* backend : {"simd", "paper"}) {
            SCOPED_TRACE("rounding mode " + std::to_string(rounding) + (flush ? ", denormals flushed, " : ", ") +
                         (pair ? "two meshes, " : "a scene, ") + backend);
            const Answer answer = answer_under(scene, rounding, flush, pair, {.backend = backend});
            EXPECT_TRUE(answer.unchanged) << "The caller's floating-point environment was not restored.";
            ASSERT_TRUE(answer.contacts) << answer.contacts.error().message;
            expected::expect_same(set, expected::listed(*answer.contacts));
          }
      }
  }
}

TEST(Environment, ThatFlushesDenormalsDoesNotHideThem) {
  const PlacedScene scene = cubes_with_corner(0x1p-1060);
  for (const bool flush : {false, true}) {
    const Answer answer = answer_under(scene, FE_TONEAREST, flush, true);
    ASSERT_TRUE(answer.contacts) << answer.contacts.error().message;
    expected::expect_same(by_plain_rationals(scene), expected::listed(*answer.contacts));
    EXPECT_TRUE(answer.unchanged);
  }
}

}  // namespace
}  // namespace impinge
