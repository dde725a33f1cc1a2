// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What deforms and touches itself: refitted trees against built ones, with a query and without, and self-collision.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/contest.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/fcl.hpp"

namespace impinge::bench {
namespace {

/// Twisted along x, by a quarter turn over its length.
scenes::MeshData twisted(scenes::MeshData mesh) {
  double most = 0;
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) most = std::max(most, std::abs(mesh.xyz[i]));
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const double angle = mesh.xyz[i] / most * std::acos(0.0) / 2, c = std::cos(angle), s = std::sin(angle);
    const double y = mesh.xyz[i + 1], z = mesh.xyz[i + 2];
    mesh.xyz[i + 1] = c * y - s * z, mesh.xyz[i + 2] = s * y + c * z;
  }
  return mesh;
}

Mesh built(const scenes::MeshData& data) {
  Mesh mesh = make_mesh(data);
  must(mesh.build_tree(1));
  return mesh;
}

void add(const Subject& subject, const std::string& what, const std::vector<Contestant>& contestants,
         const Effort& effort, Table& table) {
  const std::vector<Times> times = contest(contestants, 1, effort);
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const Spread ratio = spread(times[c].ratio);
    table.add({subject.name, count(subject.data.triangle_count()), what, contestants[c].name,
               milliseconds(median(times[c].seconds)), digits(ratio.median), digits(ratio.low), digits(ratio.high)});
  }
}

void measure(const Subject& subject, const Effort& effort, Table& table) {
  const scenes::MeshData after = twisted(subject.data);
  const Mesh mesh = built(subject.data);
  FclDebianMesh fcl(subject.data), fcl_other(subject.data);
  const scenes::PosePair poses = random_poses(mesh, Depth::light, 1).front();
  const auto ask = [&](const Mesh& deformed) { (void)must(collide(deformed, poses.a, mesh, poses.b, fast())); };
  add(subject, "refit",
      {{"impinge", [&](std::size_t) { (void)must(mesh.deformed(after.xyz)); }},
       {"impinge built anew", [&](std::size_t) { (void)built(after); }},
       {"impinge without tree", [&](std::size_t) { (void)make_mesh(after); }},
       {"FCL", [&](std::size_t) { fcl.refit(after); }},
       {"FCL built anew", [&](std::size_t) { (void)FclDebianMesh(after); }}},
      effort, table);
  add(subject, "refit and query",
      {{"impinge", [&](std::size_t) { ask(must(mesh.deformed(after.xyz))); }},
       {"impinge built as far as needed", [&](std::size_t) { ask(make_mesh(after)); }},
       {"FCL", [&](std::size_t) { fcl.refit(after), (void)fcl.collide(poses.a, fcl_other, poses.b); }}},
      effort, table);
  const Mesh deformed = built(after);
  const CgalSurface cgal(after);
  std::vector<TrianglePair> ours, theirs;
  add(subject, "self",
      {{"impinge", [&](std::size_t) { ours = must(self_collide(deformed, {}, fast())).triangles; }},
       {"CGAL", [&](std::size_t) { theirs = cgal.self_intersections(); }}},
      effort, table);
  if (ours != theirs) std::fprintf(stderr, "%s: %zu and %zu pairs\n", subject.name.c_str(), ours.size(), theirs.size());
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 1};
  Table table({"mesh", "triangles", "what", "library", "ms", "ratio", "ratio_low", "ratio_high"});
  for (const Subject& subject :
       {torus_knot_subject(9612), demo_subject("armadillo.off"), demo_subject("refined_elephant.off")})
    measure(subject, effort, table);
  table.write(arguments.folder, "deforming");
}

}  // namespace impinge::bench
