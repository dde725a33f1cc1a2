// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// One answer (contract 3.1): whatever computes it, and in however large parts, it is the oracle's.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <string>
#include <utility>
#include <vector>

#include "expected.hpp"
#include "impinge/scene.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge {
namespace {

using scenes::PlacedScene;
using scenes::Random;

std::vector<std::pair<std::string, PlacedScene>> small_scenes() {
  Random random(1);
  const auto moved = [&](const PlacedScene& scene, double reach) {
    return scenes::moved(scene, scenes::random_motion(random, reach));
  };
  const auto soup = [&] { return scenes::triangle_soup(random, 80, 0.5); };
  const auto knots = [&] {
    PlacedScene scene = scenes::shifted_pair(scenes::torus_knot_of(968), {0.4, 0.2, 0.1});
    scene.objects[1].pose.R = scenes::random_rotation(random);
    return scene;
  };
  PlacedScene stretched = scenes::shifted_pair(scenes::bumpy_grid(9, 9), {1, 0, 0});
  stretched.objects[0].pose = stretched.objects[1].pose = {scenes::stretched_rotation(random), {1e6, -1e6, 1e6}};
  return {
      {"flush boxes", moved(scenes::flush_boxes(3, 2, 1), 10)},
      {"T-junctions", scenes::t_junctions(3)},
      {"T-junctions, moved", moved(scenes::t_junctions(3), 1e6)},
      {"stretched, far away", stretched},
      {"integers", scenes::pair_scene(scenes::integer_soup(random, 90, 3), scenes::integer_soup(random, 90, 3))},
      {"degenerate", scenes::pair_scene(scenes::degenerate_soup(random, 70, 3), scenes::integer_soup(random, 70, 3))},
      {"slivers", moved(scenes::pair_scene(scenes::sliver_soup(random, 60), soup()), 1)},
      {"general position", moved(scenes::pair_scene(soup(), soup()), 1)},
      {"knots", knots()},
      {"scattered balls", scenes::scattered(random, scenes::uv_sphere(9, 8), 8, 3)},
  };
}

class SmallScene : public testing::TestWithParam<std::size_t> {};

TEST_P(SmallScene, HasOneAnswerInEveryWay) {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const auto [name, scene] = small_scenes()[GetParam()];
  SCOPED_TRACE(name);
  const expected::Set set = expected::expect_exact(scene);
  EXPECT_FALSE(set.empty());
  // A hash of this very scene, come by in the plainest way; results_test holds the formula.
  const std::uint64_t hash = expected::hash_by_scene(scene, {.threads = 1, .backend = "paper"});
  for (const test::Way& way : test::all_ways()) {
    expected::expect_way(set, hash, scene, way);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SmallScene, testing::Range<std::size_t>(0, small_scenes().size()));

}  // namespace
}  // namespace impinge
