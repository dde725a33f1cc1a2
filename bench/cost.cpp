// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The cost function T of the paper's way and of our own, with constants measured once, beside the measured time.
#include "schedule/cost.hpp"

#include "bench/assemblies.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "scenes/placed.hpp"

namespace impinge::bench {
namespace {

class CostTable {
 public:
  void add(const std::string& query, const Options& options, const Statistics& s) {
    std::vector<std::string> row{query, std::string(options.backend)};
    for (const schedule::CostTerm& term : schedule::kCostTerms) row.push_back(count(s.*term.count));
    row.insert(row.end(), {milliseconds(s.predicted_seconds), milliseconds(s.measured_seconds),
                           digits(s.predicted_seconds / s.measured_seconds)});
    table_.add(std::move(row));
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "cost"); }

 private:
  Table table_{{"query", "backend", "N_b", "N_m", "N_s", "N_o", "N_v", "N_p", "N_u", "N_t", "N_l", "N_e",
                "predicted ms", "measured ms", "predicted / measured"}};
};

void add_constants(const Options& options, Table& table) {
  const Mesh any = make_mesh(torus_knot_subject(968).data);
  const Statistics s = must(collide(any, {}, any, {}, options)).statistics;
  std::vector<std::string> row{std::string(options.backend)};
  for (const schedule::CostTerm& term : schedule::kCostTerms) row.push_back(nanoseconds(s.*term.seconds));
  table.add(std::move(row));
}

void add_mesh_pairs(const Subject& subject, int poses, int repeats, const Options& options, CostTable& table) {
  for (const Depth depth : {Depth::light, Depth::deep}) {
    std::vector<Statistics> first(static_cast<std::size_t>(repeats)), again = first;
    const auto pairs = random_poses(make_mesh(subject.data), depth, poses);
    for (int i = 0; i < repeats; ++i) {
      const Mesh mesh = make_mesh(subject.data);  // anew, so that its tree is made anew
      for (Statistics* sum : {&first[static_cast<std::size_t>(i)], &again[static_cast<std::size_t>(i)]})
        for (const auto& [a, b] : pairs) bench::add(*sum, must(collide(mesh, a, mesh, b, options)).statistics);
    }
    const std::string name = subject.name + " of " + count(subject.data.triangles.size()) + " " + name_of(depth) +
                             " (" + count(pairs.size()) + " poses)";
    table.add(name + " first", options, median(first));
    table.add(name + " repeated", options, median(again));
  }
}

template <class MakeScene>
void add_scene(const std::string& name, int repeats, const MakeScene& make_scene, const Options& options,
               CostTable& table) {
  std::vector<Statistics> first, again;
  for (int i = 0; i < repeats; ++i) {
    const Scene scene = make_scene();
    first.push_back(must(scene.collide(options)).statistics);
    again.push_back(must(scene.collide(options)).statistics);
  }
  table.add(name + " first", options, median(first));
  table.add(name + " repeated", options, median(again));
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int poses = arguments.quick ? 10 : 40, repeats = arguments.quick ? 1 : 5;
  Table constants(
      {"backend", "C_b ns", "C_m ns", "C_s ns", "C_o ns", "C_v ns", "C_p ns", "C_u ns", "C_t ns", "C_l ns", "C_e ns"});
  CostTable table;
  for (Options options : {fast(), paper_way()}) {
    options.predict_cost = true;
    add_constants(options, constants);
    add_mesh_pairs(torus_knot_subject(968), poses, repeats, options, table);
    add_mesh_pairs(torus_knot_subject(9612), poses, repeats, options, table);
    add_mesh_pairs(demo_subject("armadillo.off"), poses, repeats, options, table);
    for (const Assembly& assembly : assemblies()) {
      const io::Model model = read_model(assembly);
      add_scene(
          assembly.name, repeats, [&] { return fresh_scene(model); }, options, table);
    }
    const scenes::PlacedScene boxes = scenes::flush_boxes(10, 10, 10);
    add_scene(
        "1000 flush boxes", repeats, [&] { return fresh_scene(boxes); }, options, table);
  }
  constants.write(arguments.folder, "cost_constants");
  table.write(arguments.folder);
}

}  // namespace impinge::bench
