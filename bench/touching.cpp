// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Scenes that touch without crossing, as parts of an assembly do, each under random common rigid motions of both
/// bodies: what each library finds, and in what time.
#include <memory>

#include "bench/contest.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/embree.hpp"
#include "bench/peers/fcl.hpp"
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

/// A family's two meshes in the terms of each library; question i is about both under `motions[i]`.
struct Players {
  Players(const scenes::PlacedScene& scene, std::vector<Pose> common)
      : motions(std::move(common)),
        a(make_mesh(scene.meshes[0])),
        b(make_mesh(scene.meshes[1])),
        fcl_a(scene.meshes[0]),
        fcl_b(scene.meshes[1]) {
    for (const Pose& motion : motions) {
      cgal_a.emplace_back(scene.meshes[0], motion).build_tree();
      cgal_b.emplace_back(scene.meshes[1], motion);
      embree_a.emplace_back(scene.meshes[0], motion, EmbreeBody::Motion::fixed);
      embree_b.emplace_back(scene.meshes[1], motion, EmbreeBody::Motion::fixed);
    }
  }

  std::vector<Pose> motions;
  Mesh a, b;
  FclDebianMesh fcl_a, fcl_b;
  std::vector<CgalBody> cgal_a, cgal_b;
  std::vector<EmbreeBody> embree_a, embree_b;
  Workspace workspace;
  Contacts answer;
  std::size_t last = 0;
};

/// Embree and CGAL stand on the world vertices themselves, which is what exactness here is about.
std::vector<Contestant> contestants_of(Players& p) {
  const auto impinge_with = [&p](const Options& options) {
    return [&p, options](std::size_t i) {
      p.workspace.recycle(std::move(p.answer));
      p.answer = must(collide(p.a, p.motions[i], p.b, p.motions[i], options, &p.workspace));
    };
  };
  const auto our_pairs = [&p] { return p.answer.triangles; };
  return {{"impinge", impinge_with(fast()), our_pairs},
          {"impinge paper", impinge_with(paper_way()), our_pairs},
          {"FCL", [&p](std::size_t i) { p.fcl_a.collide(p.motions[i], p.fcl_b, p.motions[i]); },
           [&p] { return p.fcl_a.pairs(); }},
          {"Embree query alone", [&p](std::size_t i) { p.embree_a[p.last = i].collide(p.embree_b[i]); },
           [&p] { return p.embree_a[p.last].pairs(); }},
          {"CGAL query alone", [&p](std::size_t i) { p.cgal_a[p.last = i].collide(p.cgal_b[i]); },
           [&p] { return p.cgal_a[p.last].pairs(); }}};
}

}  // namespace

void bench_main(const Arguments& arguments) {
  constexpr double kReach = 10;
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 1};
  ContestTable table({"family"});
  for (const Family& family : families()) {
    scenes::Random random(7);
    std::vector<Pose> motions;
    for (int i = 0; i < (arguments.quick ? 5 : 20); ++i) motions.push_back(scenes::random_motion(random, kReach));
    Players players(family.scene, std::move(motions));
    std::vector<std::vector<TrianglePair>> exact;
    for (const Pose& motion : players.motions) exact.push_back(exact_answer(players.a, motion, players.b, motion));
    table.add({family.name}, contestants_of(players), exact, effort);
  }
  table.write(arguments.folder, "touching");
}

}  // namespace impinge::bench
