// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/mesh_pairs.hpp"

#include "bench/mutual_motion.hpp"
#include "bench/support.hpp"
#include "impinge/collide.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

bool apart(const Mesh& mesh, const scenes::PosePair& poses) {
  return must(collide(mesh, poses.a, mesh, poses.b, {.find = Options::Find::first})).triangles.empty();
}

scenes::PosePair random_pose(scenes::Random& random, const Mesh& mesh, Depth depth, double thickness) {
  constexpr double kGap = 0.01, kPastFirstTouch = 0.03, kCentersApart = 0.2;
  if (depth == Depth::deep) return scenes::centers_apart(random, mesh, mesh, kCentersApart * thickness);
  if (depth == Depth::light) return must(scenes::near_first_touch(random, mesh, mesh, kPastFirstTouch));
  // Bisection finds some first touch along the line; now and then there was another one before it.
  for (;;)
    if (const auto poses = must(scenes::near_first_touch(random, mesh, mesh, -kGap)); apart(mesh, poses)) return poses;
}

}  // namespace

Subject torus_knot_subject(int triangles) { return {"torus knot", scenes::torus_knot_of(triangles)}; }

Subject demo_subject(const std::string& file) { return {std::filesystem::path(file).stem().string(), demo_mesh(file)}; }

Subject elongated(Subject subject) {
  std::vector<double>& xyz = subject.data.xyz;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double along = 9 * (xyz[i] + xyz[i + 1] + xyz[i + 2]) / 3;  // nine more of the part along (1, 1, 1)
    for (std::size_t k = 0; k < 3; ++k) xyz[i + k] += along;
  }
  subject.thickness /= 10;
  return subject;
}

std::vector<Subject> paper_subjects() {
  std::vector<Subject> subjects;
  for (const int triangles : kPaperSizes) subjects.push_back(torus_knot_subject(triangles));
  return subjects;
}

const char* name_of(Depth depth) {
  switch (depth) {
    case Depth::near:
      return "near miss";
    case Depth::light:
      return "light";
    case Depth::deep:
      break;
  }
  return "deep";
}

std::vector<scenes::PosePair> random_poses(const Mesh& mesh, Depth depth, int poses, double thickness) {
  // One seed for all: meshes of one shape and different sizes get the same turns.
  scenes::Random random(20080901);
  std::vector<scenes::PosePair> pairs;
  for (int i = 0; i < poses; ++i) pairs.push_back(random_pose(random, mesh, depth, thickness));
  return pairs;
}

}  // namespace impinge::bench
