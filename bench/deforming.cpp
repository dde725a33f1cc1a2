// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What deforms and touches itself: trees refitted as far as a query needs them and wholly, against built ones, with a
/// query and without, and against those made without a plan; self-collision; and impacts between two states. With
/// IMPINGE_CCD_DIR in the environment, those of its steps too (docs/motion.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bench/contest.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/embree.hpp"
#include "bench/peers/fcl.hpp"
#include "bench/peers/fcl_impacts.hpp"
#include "bench/support.hpp"
#include "impinge/impacts.hpp"
#include "impinge/io.hpp"

namespace impinge::bench {
namespace {

/// Twisted along x, by so many quarter turns over its length.
scenes::MeshData twisted(scenes::MeshData mesh, double turns = 1) {
  double most = 0;
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) most = std::max(most, std::abs(mesh.xyz[i]));
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const double angle = turns * mesh.xyz[i] / most * std::acos(0.0) / 2, c = std::cos(angle), s = std::sin(angle);
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

/// All vertices and faces, and all pairs of edges, that share no vertex and whose boxes around both states meet: by
/// sweep and prune along x.
std::vector<FclFeatures> candidates(const Mesh& mesh, const std::vector<double>& from, const std::vector<double>& to) {
  struct Swept {
    double lo[3], hi[3];
    std::array<std::uint32_t, 3> vertices;
    std::size_t count;
  };
  std::vector<Swept> all;
  const auto add = [&](std::size_t count, std::array<std::uint32_t, 3> vertices) {
    Swept swept{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, vertices, count};
    for (std::size_t i = 0; i < count; ++i)
      for (const auto* xyz : {&from, &to})
        for (std::size_t k = 0; k < 3; ++k) {
          const double x = (*xyz)[3 * std::size_t{vertices[i]} + k];
          swept.lo[k] = std::min(swept.lo[k], x), swept.hi[k] = std::max(swept.hi[k], x);
        }
    all.push_back(swept);
  };
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) add(1, {i, i, i});
  for (const auto& e : mesh.edges()) add(2, {e[0], e[1], e[1]});
  for (const auto& c : mesh.triangles()) add(3, c);
  std::sort(all.begin(), all.end(), [](const Swept& a, const Swept& b) { return a.lo[0] < b.lo[0]; });
  std::vector<FclFeatures> pairs;
  std::vector<Swept> open;
  for (const Swept& b : all) {
    std::erase_if(open, [&](const Swept& a) { return a.hi[0] < b.lo[0]; });
    for (const Swept& a : open) {
      if (a.count + b.count != 4 || a.hi[1] < b.lo[1] || b.hi[1] < a.lo[1] || a.hi[2] < b.lo[2] || b.hi[2] < a.lo[2])
        continue;
      bool share = false;
      for (const std::uint32_t i : a.vertices)
        for (const std::uint32_t j : b.vertices) share |= i == j;
      if (share) continue;
      const Swept &one = a.count <= b.count ? a : b, &two = a.count <= b.count ? b : a;
      if (one.count == 2)
        pairs.push_back({true, {one.vertices[0], one.vertices[1], two.vertices[0], two.vertices[1]}});
      else
        pairs.push_back({false, {one.vertices[0], two.vertices[0], two.vertices[1], two.vertices[2]}});
    }
    open.push_back(b);
  }
  return pairs;
}

void measure_impacts(const Subject& subject, const std::vector<double>& to, const Effort& effort, Table& table) {
  const Mesh mesh = make_mesh(subject.data);
  const Moving moving{mesh, must(mesh.deformed(to))};
  const std::vector<FclFeatures> pairs = candidates(mesh, subject.data.xyz, to);
  // As far apart as edges are long in the mean, and a tenth of that.
  double length = 0;
  for (const auto& [i, j] : mesh.edges()) {
    const Point &p = mesh.vertices()[i], &q = mesh.vertices()[j];
    length += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) / static_cast<double>(mesh.edges().size());
  }
  const auto ask = [&](bool earliest, double separation = 0) {
    return must(find_impacts(moving, {.earliest = earliest, .separation = separation, .threads = 1}));
  };
  std::printf("%s: %zu pairs of features whose boxes meet, %zu impacts\n", subject.name.c_str(), pairs.size(),
              ask(false).impacts.size());
  add(subject, "impacts",
      {{"impinge", [&](std::size_t) { (void)ask(false); }},
       {"impinge for the first", [&](std::size_t) { (void)ask(true); }},
       {"impinge a tenth of an edge apart", [&](std::size_t) { (void)ask(false, length / 10); }},
       {"impinge an edge apart", [&](std::size_t) { (void)ask(false, length); }},
       {"FCL's tests alone", [&](std::size_t) { (void)FclImpacts::count(subject.data.xyz, to, pairs); }}},
      effort, table);
}

/// A mesh that moves into another, which is at rest: from beside it, along x, to where most of it is inside.
void measure_passage(const Subject& subject, const Effort& effort, Table& table) {
  const Mesh mesh = make_mesh(subject.data);
  double low = 0, high = 0;
  for (const Point& p : mesh.vertices()) low = std::min(low, p.x), high = std::max(high, p.x);
  const auto beside = [&](double share) {
    std::vector<double> xyz = subject.data.xyz;
    for (std::size_t i = 0; i < xyz.size(); i += 3) xyz[i] += share * (high - low);
    return must(mesh.deformed(xyz));
  };
  const Moving resting{mesh, mesh}, moving{beside(1.1), beside(0.3)};
  const auto ask = [&](bool earliest) {
    (void)must(find_impacts(resting, moving, {.earliest = earliest, .threads = 1}));
  };
  add(subject, "impacts of two",
      {{"impinge", [&](std::size_t) { ask(false); }}, {"impinge for the first", [&](std::size_t) { ask(true); }}},
      effort, table);
}

/// Folders of scenes, each with a folder `frames` of meshes N.ply and N + 1.ply.
void measure_public_steps(const std::filesystem::path& folder, const Effort& effort, Table& table) {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::is_directory(entry.path() / "frames")) scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& scene : scenes) {
    std::vector<std::filesystem::path> frames;
    for (const auto& entry : std::filesystem::directory_iterator(scene / "frames")) frames.push_back(entry.path());
    std::sort(frames.begin(), frames.end());
    const auto data = [&](std::size_t i) { return numbers_of(must(io::read(frames.at(i))).objects.at(0).mesh); };
    measure_impacts({scene.filename().string(), data(0)}, data(1).xyz, effort, table);
  }
}

void measure(const Subject& subject, const Effort& effort, Table& table) {
  const scenes::MeshData after = twisted(subject.data);
  const Mesh mesh = built(subject.data), sparse = make_mesh(subject.data);
  FclDebianMesh fcl(subject.data), fcl_other(subject.data);
  const scenes::PosePair poses = random_poses(mesh, Depth::light, 1).front();
  EmbreeBody embree(subject.data, poses.a, EmbreeBody::Motion::moving),
      embree_other(subject.data, poses.b, EmbreeBody::Motion::fixed);
  const auto ask = [&](const Mesh& deformed) { (void)must(collide(deformed, poses.a, mesh, poses.b, fast())); };
  add(subject, "refit",
      {{"impinge", [&](std::size_t) { (void)must(mesh.deformed(after.xyz)); }},
       {"impinge the whole tree", [&](std::size_t) { must(must(mesh.deformed(after.xyz)).build_tree(1)); }},
       {"impinge built anew", [&](std::size_t) { (void)built(after); }},
       {"impinge without tree", [&](std::size_t) { (void)make_mesh(after); }},
       {"FCL", [&](std::size_t) { fcl.refit(after); }},
       {"Embree", [&](std::size_t) { embree.deform(after, poses.a); }},
       {"FCL built anew", [&](std::size_t) { (void)FclDebianMesh(after); }}},
      effort, table);
  add(subject, "refit and query",
      {{"impinge", [&](std::size_t) { ask(must(mesh.deformed(after.xyz))); }},
       {"impinge without a plan", [&](std::size_t) { ask(must(sparse.deformed(after.xyz))); }},
       {"FCL", [&](std::size_t) { fcl.refit(after), (void)fcl.collide(poses.a, fcl_other, poses.b); }},
       {"Embree", [&](std::size_t) { embree.deform(after, poses.a), (void)embree.collide(embree_other); }}},
      effort, table);
  const Mesh deformed = built(after);
  const CgalSurface cgal(after);
  std::vector<TrianglePair> ours, theirs;
  add(subject, "self",
      {{"impinge", [&](std::size_t) { ours = must(self_collide(deformed, {}, fast())).triangles; }},
       {"CGAL", [&](std::size_t) { theirs = cgal.self_intersections(); }}},
      effort, table);
  add(subject, "refit and self",
      {{"impinge", [&](std::size_t) { (void)must(self_collide(must(mesh.deformed(after.xyz)), {}, fast())); }},
       {"CGAL", [&](std::size_t) { (void)cgal.self_intersections(); }}},
      effort, table);
  if (ours != theirs) std::fprintf(stderr, "%s: %zu and %zu pairs\n", subject.name.c_str(), ours.size(), theirs.size());
  measure_impacts(subject, twisted(subject.data, 0.01).xyz, effort, table);
  measure_passage(subject, effort, table);
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const Effort effort = arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 1};
  Table table({"mesh", "triangles", "what", "library", "ms", "ratio", "ratio_low", "ratio_high"});
  for (const Subject& subject :
       {torus_knot_subject(9612), demo_subject("armadillo.off"), demo_subject("refined_elephant.off")})
    measure(subject, effort, table);
  if (const char* const folder = std::getenv("IMPINGE_CCD_DIR")) measure_public_steps(folder, effort, table);
  table.write(arguments.folder, "deforming");
}

}  // namespace impinge::bench
