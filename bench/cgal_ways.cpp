// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Ways to use CGAL's tree: which one the other tables should take, and what the others cost.
#include "bench/peers/cgal_ways.hpp"

#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {
namespace {

std::vector<Contestant> with_ways(std::vector<Contestant> contestants, CgalWays& ways,
                                  const std::vector<scenes::PosePair>& poses) {
  std::erase_if(contestants, [](const Contestant& c) { return c.name != "impinge" && !c.name.starts_with("CGAL"); });
  const auto add = [&](const char* name, void (CgalWays::*way)(const Pose&, const Pose&)) {
    contestants.push_back({name, [&ways, &poses, way](std::size_t i) { (ways.*way)(poses[i].a, poses[i].b); },
                           [&] { return ways.pairs(); }});
  };
  add("CGAL moved triangles", &CgalWays::moved_triangles);
  add("CGAL moved triangles EPECK", &CgalWays::moved_triangles_epeck);
  add("CGAL own boxes", &CgalWays::own_boxes);
  add("CGAL own two trees", &CgalWays::own_two_trees);
  return contestants;
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int poses_each = arguments.quick ? 4 : 12;
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 5, 1};
  ContestTable table({"mesh", "triangles", "case"});
  for (const Subject& subject : {torus_knot_subject(968), torus_knot_subject(9612), demo_subject("armadillo.off")}) {
    Copies copies(subject.data);
    CgalWays ways(subject.data);
    for (const Depth depth : {Depth::light, Depth::deep}) {
      const auto poses = random_poses(copies.mesh, depth, poses_each);
      table.add({subject.name, count(copies.mesh.triangle_count()), name_of(depth)},
                with_ways(pair_contestants(copies, poses), ways, poses), exact_answers(copies.mesh, poses), effort);
    }
  }
  table.write(arguments.folder, "cgal_ways");
}

}  // namespace impinge::bench
