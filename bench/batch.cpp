// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// A batch of poses of two bodies, as a planner asks about: one call, a call a pose, and FCL pose by pose. Half of the
/// poses are near misses.
#include "bench/contest.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {
namespace {

std::vector<scenes::PosePair> mixed_poses(const Mesh& mesh, int poses) {
  const auto near = random_poses(mesh, Depth::near, poses / 2), light = random_poses(mesh, Depth::light, poses / 2);
  std::vector<scenes::PosePair> mixed;
  for (std::size_t i = 0; i < near.size(); ++i) {
    mixed.push_back(near[i]);
    mixed.push_back(light[i]);
  }
  return mixed;
}

void measure(const Subject& subject, Options::Find find, int number, const Effort& effort, Table& table) {
  const Mesh mesh = make_mesh(subject.data);
  FclDebianMesh fcl(subject.data);
  const auto poses = mixed_poses(mesh, number);
  std::vector<Pose> poses_a, poses_b;
  for (const auto& [a, b] : poses) {
    poses_a.push_back(a);
    poses_b.push_back(b);
  }
  Options options = fast();
  options.find = find;
  const bool first = find == Options::Find::first;
  const std::size_t limit = first ? 1 : std::numeric_limits<std::size_t>::max();
  Workspace workspace;
  const auto one_by_one = [&] {
    for (const auto& [a, b] : poses) workspace.recycle(must(collide(mesh, a, mesh, b, options, &workspace)));
  };
  const std::vector<Contestant> contestants{
      {"impinge",
       [&](std::size_t) { workspace.recycle(must(collide_poses(mesh, poses_a, mesh, poses_b, options, &workspace))); }},
      {"impinge pose by pose", [&](std::size_t) { one_by_one(); }},
      {"FCL pose by pose",
       [&](std::size_t) {
         for (const auto& [a, b] : poses) fcl.collide(a, fcl, b, limit);
       }},
  };
  std::size_t pairs = 0;
  for (const auto& [a, b] : poses) pairs += must(collide(mesh, a, mesh, b, options)).triangles.size();
  if (must(collide_poses(mesh, poses_a, mesh, poses_b, options)).triangles.size() != pairs)
    fail("a batch of poses does not find what its poses find one by one");
  const std::vector<Times> times = contest(contestants, 1, effort);
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const Spread ratio = spread(times[c].ratio);
    table.add({subject.name, count(mesh.triangle_count()), first ? "first contact" : "all pairs", count(poses.size()),
               contestants[c].name, digits(1e6 * median(times[c].seconds) / static_cast<double>(poses.size())),
               digits(ratio.median), digits(ratio.low), digits(ratio.high)});
  }
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int poses = arguments.quick ? 100 : 1000;
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{5, 9, 2};
  Table table({"mesh", "triangles", "question", "poses", "library", "us_a_pose", "ratio", "ratio_low", "ratio_high"});
  for (const Subject& subject : {torus_knot_subject(968), torus_knot_subject(9612)})
    for (const Options::Find find : {Options::Find::all, Options::Find::first})
      measure(subject, find, poses, effort, table);
  table.write(arguments.folder, "batch");
}

}  // namespace impinge::bench
