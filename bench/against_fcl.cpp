// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge and FCL in one run, on one core, in turns: every pair of touching triangles of two rigid copies of a mesh.
#include "bench/fcl_errors.hpp"
#include "bench/fcl_peer.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/support.hpp"
#include "impinge/collide.hpp"

namespace impinge::bench {
namespace {

const Options kOneThread{.threads = 1};

struct Sizes {
  int poses, repeats, builds;
};

struct Answers {
  std::uint64_t pairs = 0;
  Disagreement fcl;
};

/// Both answers at each pose, not timed. Warms both sides up as well, and makes the nodes of our tree.
Answers compare_answers(const Mesh& mesh, FclMesh& fcl, const std::vector<scenes::PosePair>& poses) {
  Answers answers;
  for (const auto& [pose_a, pose_b] : poses) {
    const Contacts exact = must(collide(mesh, pose_a, mesh, pose_b, kOneThread));
    fcl.collide(pose_a, fcl, pose_b);
    const Disagreement wrong = compare(exact.triangles, fcl.pairs());
    answers.pairs += exact.triangles.size();
    answers.fcl.missed += wrong.missed;
    answers.fcl.added += wrong.added;
  }
  return answers;
}

/// A query's mean time over all poses, a repeat.
struct Times {
  std::vector<double> impinge, fcl, ratio;
};

Times time_in_turns(const Mesh& mesh, FclMesh& fcl, const std::vector<scenes::PosePair>& poses, int repeats) {
  const auto n = static_cast<double>(poses.size());
  const auto run_impinge = [&] {
    for (const auto& [pose_a, pose_b] : poses) (void)must(collide(mesh, pose_a, mesh, pose_b, kOneThread));
  };
  const auto run_fcl = [&] {
    for (const auto& [pose_a, pose_b] : poses) fcl.collide(pose_a, fcl, pose_b);
  };
  Times times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const bool fcl_first = repeat % 2 == 0;
    double ours = fcl_first ? 0 : seconds_of(run_impinge) / n;
    const double theirs = seconds_of(run_fcl) / n;
    if (fcl_first) ours = seconds_of(run_impinge) / n;
    times.impinge.push_back(ours);
    times.fcl.push_back(theirs);
    times.ratio.push_back(ours / theirs);
  }
  return times;
}

Statistics sum_of_statistics(const Mesh& mesh, const std::vector<scenes::PosePair>& poses) {
  Statistics sum;
  for (const auto& [pose_a, pose_b] : poses) add(sum, must(collide(mesh, pose_a, mesh, pose_b, kOneThread)).statistics);
  return sum;
}

struct Tables {
  Table speed{{"mesh", "triangles", "depth", "pairs a query", "FCL ms", "impinge ms", "impinge / FCL", "lowest",
               "highest", "FCL misses", "FCL adds", "of pairs"}};
  Table stages{{"mesh", "triangles", "depth", "box tests", "leaf pairs", "element tests", "triangle pairs",
                "exact calls", "hierarchy", "partition", "narrow", "exact", "results"}};
  Table build{{"mesh", "triangles", "FCL build ms", "impinge create ms", "first query ms", "repeated query ms"}};
};

void measure_queries(const Subject& subject, const Mesh& mesh, FclMesh& fcl, Sizes sizes, Tables& tables) {
  const std::string triangles = count(mesh.triangle_count());
  for (const Depth depth : kDepths) {
    const auto poses = random_poses(mesh, depth, sizes.poses);
    const auto n = static_cast<double>(poses.size());
    const Answers answers = compare_answers(mesh, fcl, poses);
    const Times times = time_in_turns(mesh, fcl, poses, sizes.repeats);
    const Spread ratio = spread(times.ratio);
    tables.speed.add({subject.name, triangles, name_of(depth), digits(static_cast<double>(answers.pairs) / n),
                      milliseconds(median(times.fcl)), milliseconds(median(times.impinge)), digits(ratio.median),
                      digits(ratio.low), digits(ratio.high), count(answers.fcl.missed), count(answers.fcl.added),
                      count(answers.pairs)});
    const Statistics s = sum_of_statistics(mesh, poses);
    const auto mean = [n](std::uint64_t sum) { return digits(static_cast<double>(sum) / n); };
    const auto share = [&s](double seconds) { return percent(seconds, s.total_seconds); };
    tables.stages.add({subject.name, triangles, name_of(depth), mean(s.box_tests), mean(s.leaf_pairs),
                       mean(s.element_tests), mean(s.triangle_pairs), mean(s.exact_calls), share(s.hierarchy_seconds),
                       share(s.partition_seconds), share(s.narrow_seconds), share(s.exact_seconds),
                       share(s.results_seconds)});
  }
}

/// FCL builds its whole tree beforehand, impinge the nodes that a query reaches: so the first query is shown too.
void measure_build(const Subject& subject, Sizes sizes, Tables& tables) {
  const Mesh probe = make_mesh(subject.data);
  const auto pose = random_poses(probe, Depth::deep, 1).front();
  std::vector<double> fcl, create, first, repeated;
  for (int i = 0; i < sizes.builds; ++i) {
    fcl.push_back(seconds_of([&] { const FclMesh built(subject.data); }));
    create.push_back(seconds_of([&] { (void)make_mesh(subject.data); }));
    const Mesh mesh = make_mesh(subject.data);
    const auto query = [&] { (void)must(collide(mesh, pose.a, mesh, pose.b, kOneThread)); };
    first.push_back(seconds_of(query));
    repeated.push_back(seconds_of(query));
  }
  tables.build.add({subject.name, count(probe.triangle_count()), milliseconds(median(fcl)),
                    milliseconds(median(create)), milliseconds(median(first)), milliseconds(median(repeated))});
}

void run(const Arguments& arguments) {
  const Sizes sizes =
      arguments.quick ? Sizes{.poses = 20, .repeats = 3, .builds = 2} : Sizes{.poses = 100, .repeats = 7, .builds = 5};
  std::vector<Subject> subjects = torus_knots();
  for (Subject& mesh : demo_meshes()) subjects.push_back(std::move(mesh));
  Tables tables;
  for (const Subject& subject : subjects) {
    const Mesh mesh = make_mesh(subject.data);
    FclMesh fcl(subject.data);
    measure_queries(subject, mesh, fcl, sizes, tables);
    measure_build(subject, sizes, tables);
  }
  tables.speed.write(arguments.folder, "fcl_speed");
  tables.stages.write(arguments.folder, "fcl_stages");
  tables.build.write(arguments.folder, "fcl_build");
  touching_families(arguments.quick ? 5 : 20).write(arguments.folder, "fcl_touching");
  fcl_on_assemblies(sizes.repeats).write(arguments.folder, "fcl_assemblies");
}

}  // namespace
}  // namespace impinge::bench

int main(int argc, char** argv) {
  const auto arguments = impinge::bench::parse_arguments(argc, argv);
  impinge::bench::pin_to_one_core();
  impinge::bench::run(arguments);
}
