// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/fcl_errors.hpp"

#include "bench/fcl_peer.hpp"
#include "impinge/collide.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

struct Family {
  std::string name;
  scenes::PlacedScene scene;  // two objects
};

std::vector<Family> families() {
  using namespace scenes;
  return {
      {"a cube on itself", shifted_pair(cube(), {0, 0, 0})},
      {"two cubes face to face", shifted_pair(cube(), {1, 0, 0})},
      {"two cubes vertex to vertex", shifted_pair(cube(), {1, 1, 1})},
      {"a box of 8 x 8 cells a side on itself", shifted_pair(box({0, 0, 0}, {1, 1, 1}, 8), {0, 0, 0})},
      {"a flat 24 x 24 grid on itself", shifted_pair(flat_grid(24, 24), {0, 0, 0})},
      {"a flat 24 x 24 grid beside itself", shifted_pair(flat_grid(24, 24), {24, 0, 0})},
      {"a flat 24 x 24 grid half a cell along", shifted_pair(flat_grid(24, 24), {0.5, 0.5, 0})},
      {"a bumpy 24 x 24 grid on itself", shifted_pair(bumpy_grid(24, 24), {0, 0, 0})},
      {"T-junctions", t_junctions(8)},
      {"a torus knot on itself", shifted_pair(torus_knot_of(968), {0, 0, 0})},
  };
}

}  // namespace

Table touching_families(int motions) {
  constexpr double kReach = 10;
  Table table({"both bodies under one motion", "motions", "pairs", "FCL misses", "FCL adds", "FCL's yes or no wrong"});
  for (const Family& family : families()) {
    scenes::Random random(7);
    const Mesh mesh_a = make_mesh(family.scene.meshes[0]), mesh_b = make_mesh(family.scene.meshes[1]);
    FclMesh fcl_a(family.scene.meshes[0]);
    const FclMesh fcl_b(family.scene.meshes[1]);
    std::uint64_t pairs = 0, wrong_answers = 0;
    Disagreement sum;
    for (int i = 0; i < motions; ++i) {
      const Pose motion = scenes::random_motion(random, kReach);
      const Contacts exact = must(collide(mesh_a, motion, mesh_b, motion, {.threads = 1}));
      fcl_a.collide(motion, fcl_b, motion);
      const std::vector<TrianglePair> found = fcl_a.pairs();
      const Disagreement wrong = compare(exact.triangles, found);
      pairs += exact.triangles.size();
      sum.missed += wrong.missed;
      sum.added += wrong.added;
      wrong_answers += exact.triangles.empty() != found.empty();
    }
    table.add({family.name, std::to_string(motions), count(pairs),
               count(sum.missed) + " (" + percent(static_cast<double>(sum.missed), static_cast<double>(pairs)) + ")",
               count(sum.added), count(wrong_answers) + " of " + std::to_string(motions)});
  }
  return table;
}

}  // namespace impinge::bench
