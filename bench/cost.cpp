// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The cost function, T = N_v C_v + N_p C_p + N_u C_u + N_l C_l + N_e C_e with constants measured once, beside the
/// measured time.
#include "bench/assemblies.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "scenes/placed.hpp"

namespace impinge::bench {
namespace {

const Options kPredict = [] {
  Options options = fast();
  options.predict_cost = true;
  return options;
}();

class CostTable {
 public:
  void add(const std::string& name, const Statistics& s) {
    table_.add({name, count(s.box_tests), count(s.element_tests), count(s.nodes_built), count(s.leaf_pairs),
                count(s.exact_calls), milliseconds(s.predicted_seconds), milliseconds(s.measured_seconds),
                digits(s.predicted_seconds / s.measured_seconds)});
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "cost"); }

 private:
  Table table_{{"query", "N_v", "N_p", "N_u", "N_l", "N_e", "predicted ms", "measured ms", "predicted / measured"}};
};

void add_mesh_pairs(const Subject& subject, int poses, int repeats, CostTable& table) {
  const Mesh mesh = make_mesh(subject.data);
  for (const Depth depth : {Depth::light, Depth::deep}) {
    const auto pairs = random_poses(mesh, depth, poses);
    std::vector<Statistics> sums(static_cast<std::size_t>(repeats));
    for (int warm = 0; warm < 2; ++warm)
      for (Statistics& sum : sums) {
        sum = {};
        for (const auto& [a, b] : pairs) bench::add(sum, must(collide(mesh, a, mesh, b, kPredict)).statistics);
      }
    table.add(subject.name + " of " + count(mesh.triangle_count()) + " " + name_of(depth) + " (" + count(pairs.size()) +
                  " poses)",
              median(sums));
  }
}

template <class MakeScene>
void add_scene(const std::string& name, int repeats, const MakeScene& make_scene, CostTable& table) {
  std::vector<Statistics> first, again;
  for (int i = 0; i < repeats; ++i) {
    const Scene scene = make_scene();
    first.push_back(must(scene.collide(kPredict)).statistics);
    again.push_back(must(scene.collide(kPredict)).statistics);
  }
  table.add(name + " first", median(first));
  table.add(name + " repeated", median(again));
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int poses = arguments.quick ? 10 : 40, repeats = arguments.quick ? 1 : 5;
  const Mesh any = make_mesh(torus_knot_subject(968).data);
  const Statistics constants = must(collide(any, {}, any, {}, kPredict)).statistics;
  Table costs({"C_v ns a box test", "C_p ns a pair of triangles", "C_u ns a tree node", "C_l ns a pair of leaves",
               "C_e ns an exact call"});
  costs.add({nanoseconds(constants.box_test_seconds), nanoseconds(constants.element_test_seconds),
             nanoseconds(constants.node_seconds), nanoseconds(constants.leaf_pair_seconds),
             nanoseconds(constants.exact_call_seconds)});
  costs.write(arguments.folder, "cost_constants");

  CostTable table;
  add_mesh_pairs(torus_knot_subject(968), poses, repeats, table);
  add_mesh_pairs(torus_knot_subject(9612), poses, repeats, table);
  add_mesh_pairs(demo_subject("armadillo.off"), poses, repeats, table);
  for (const Assembly& assembly : assemblies()) {
    const io::Model model = read_model(assembly);
    add_scene(
        assembly.name, repeats, [&] { return fresh_scene(model); }, table);
  }
  const scenes::PlacedScene boxes = scenes::flush_boxes(10, 10, 10);
  add_scene(
      "1000 flush boxes", repeats, [&] { return fresh_scene(boxes); }, table);
  table.write(arguments.folder);
}

}  // namespace impinge::bench
