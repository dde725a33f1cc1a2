// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Every library on two rigid copies of one mesh, from 1,000 to 1,000,000 triangles: near misses, light and deep
/// contact, every pair of triangles or the first one only; then a thousand small steps of a motion.
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "bench/pair_contestants.hpp"

namespace impinge::bench {
namespace {

struct Sizes {
  int small, medium, large;  // poses of a mesh up to 20,000 triangles, up to 200,000, beyond
  int steps;
  Effort effort;
};

constexpr Sizes kFull{.small = 60, .medium = 20, .large = 5, .steps = 1000, .effort = {3, 7, 2}};
constexpr Sizes kQuick{.small = 8, .medium = 3, .large = 2, .steps = 50, .effort = {2, 2, 0}};

int poses_for(std::size_t triangles, const Sizes& sizes) {
  return triangles <= 20'000 ? sizes.small : triangles <= 200'000 ? sizes.medium : sizes.large;
}

class PairTables {
 public:
  explicit PairTables(const Sizes& sizes) : sizes_(sizes) {}

  void add(const char* shape, const Subject& subject) {
    Copies copies(subject.data);
    const std::string triangles = count(copies.mesh.triangle_count());
    for (const Depth depth : kDepths) {
      const int number = poses_for(copies.mesh.triangle_count(), sizes_);
      const auto poses = random_poses(copies.mesh, depth, number, subject.thickness);
      const auto exact = exact_answers(copies.mesh, poses);
      std::vector<std::string> cells{shape, subject.name, triangles, name_of(depth)};
      pairs_.add(cells, pair_contestants(copies, poses), exact, sizes_.effort);
      add_stages(cells, copies.mesh, poses);
      if (depth == Depth::deep) continue;
      cells.back() = depth == Depth::near ? "first contact near miss" : "first contact light";
      pairs_.add(cells, pair_contestants(copies, poses, {.first = true}), yes_or_no(exact), sizes_.effort);
    }
  }

  void add_steps(const Subject& subject) {
    Copies copies(subject.data);
    const auto poses = scenes::small_steps(copies.mesh, sizes_.steps);
    pairs_.add({"compact", subject.name, count(copies.mesh.triangle_count()), "small steps"},
               pair_contestants(copies, poses, {.query_alone = false}), exact_answers(copies.mesh, poses),
               sizes_.effort);
  }

  void write(const std::filesystem::path& folder) const {
    pairs_.write(folder, "pairs");
    stages_.write(folder, "stages");
  }

 private:
  /// Means a query of what impinge counted, and the share of its time in each stage.
  void add_stages(std::vector<std::string> cells, const Mesh& mesh, const std::vector<scenes::PosePair>& poses) {
    Statistics sum;
    for (const auto& [a, b] : poses) bench::add(sum, must(collide(mesh, a, mesh, b, timed())).statistics);
    for (const std::uint64_t number :
         {sum.box_tests, sum.leaf_pairs, sum.element_tests, sum.triangle_pairs, sum.exact_calls})
      cells.push_back(digits(static_cast<double>(number) / static_cast<double>(poses.size())));
    for (const double seconds :
         {sum.hierarchy_seconds, sum.partition_seconds, sum.narrow_seconds, sum.exact_seconds, sum.results_seconds})
      cells.push_back(percent(seconds, sum.total_seconds));
    stages_.add(std::move(cells));
  }

  Sizes sizes_;
  ContestTable pairs_{{"shape", "mesh", "triangles", "case"}};
  Table stages_{{"shape", "mesh", "triangles", "case", "box tests", "leaf pairs", "element tests", "triangle pairs",
                 "exact calls", "hierarchy", "partition", "narrow", "exact", "results"}};
};

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  PairTables tables(arguments.quick ? kQuick : kFull);
  const std::vector<int> knots = arguments.quick ? std::vector{968, 9612, 100'000}
                                                 : std::vector{968, 3162, 9612, 31'620, 100'000, 316'200, 1'000'000};
  const std::vector<int> long_knots = arguments.quick ? std::vector{9612} : std::vector{968, 9612, 100'000, 1'000'000};
  const std::vector<std::string> files = arguments.quick
                                             ? std::vector<std::string>{"armadillo.off"}
                                             : std::vector<std::string>{"elephant.off", "fandisk.off", "camel.off",
                                                                        "armadillo.off", "refined_elephant.off"};
  for (const int triangles : knots) tables.add("compact", torus_knot_subject(triangles));
  for (const std::string& file : files) tables.add("compact", demo_subject(file));
  for (const int triangles : long_knots) tables.add("elongated", elongated(torus_knot_subject(triangles)));
  if (!arguments.quick) tables.add("elongated", elongated(demo_subject("armadillo.off")));
  tables.add_steps(torus_knot_subject(9612));
  if (!arguments.quick) tables.add_steps(demo_subject("armadillo.off"));
  tables.write(arguments.folder);
}

}  // namespace impinge::bench
