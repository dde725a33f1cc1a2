// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/mesh_pairs.hpp"

#include "bench/support.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {

std::vector<Subject> torus_knots() {
  std::vector<Subject> subjects;
  for (const int triangles : {968, 3162, 5200, 7590, 9612})
    subjects.push_back({"torus knot", scenes::torus_knot_of(triangles)});
  return subjects;
}

std::vector<Subject> demo_meshes() {
  std::vector<Subject> subjects;
  for (const char* file : {"elephant.off", "fandisk.off", "armadillo.off"}) subjects.push_back({file, demo_mesh(file)});
  return subjects;
}

const char* name_of(Depth depth) { return depth == Depth::light ? "light" : "deep"; }

std::vector<scenes::PosePair> random_poses(const Mesh& mesh, Depth depth, int poses) {
  constexpr double kPastFirstTouch = 0.03, kCentersApart = 0.2;
  scenes::Random random(20080901 + mesh.triangle_count());
  std::vector<scenes::PosePair> pairs;
  for (int i = 0; i < poses; ++i)
    pairs.push_back(depth == Depth::light ? must(scenes::near_first_touch(random, mesh, mesh, kPastFirstTouch))
                                          : scenes::centers_apart(random, mesh, mesh, kCentersApart));
  return pairs;
}

}  // namespace impinge::bench
