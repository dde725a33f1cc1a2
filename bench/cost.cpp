// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The cost function T of the paper's way and of our own, with constants measured once, beside the measured time.
#include "schedule/cost.hpp"

#include <algorithm>
#include <array>

#include "bench/assemblies.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"
#include "pipeline/calibration.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

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

/// A question that makes the trees, and the same again.
struct Asked {
  Statistics first, again;
};

/// As the constants are read off the quickest of some runs, so are the times that T is held against.
Statistics quickest(const std::vector<Statistics>& runs) {
  return *std::min_element(runs.begin(), runs.end(), [](const Statistics& p, const Statistics& q) {
    return p.measured_seconds < q.measured_seconds;
  });
}

Asked ask_pairs(const Subject& subject, const std::vector<scenes::PosePair>& pairs, int repeats, const Options& options,
                const TreeConfig& tree = {}) {
  std::vector<Statistics> first(static_cast<std::size_t>(repeats)), again = first;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Mesh mesh = make_mesh(subject.data, tree);  // anew, so that its tree is made anew
    for (Statistics* sum : {&first[i], &again[i]})
      for (const auto& [a, b] : pairs) bench::add(*sum, must(collide(mesh, a, mesh, b, options)).statistics);
  }
  return {quickest(first), quickest(again)};
}

template <class MakeScene>
Asked ask_scene(int repeats, const MakeScene& make_scene, const Options& options) {
  std::vector<Statistics> first, again;
  for (int i = 0; i < repeats; ++i) {
    const Scene scene = make_scene();
    first.push_back(must(scene.collide(options)).statistics);
    again.push_back(must(scene.collide(options)).statistics);
  }
  return {quickest(first), quickest(again)};
}

/// T, with constants measured for each leaf size, and the time. Where a leaf holds a whole mesh there is no tree, and
/// its triangles are tested directly.
class LeafTable {
 public:
  static constexpr std::array<std::uint32_t, 7> kLeafSizes{0, 4, 8, 16, 32, 64, 128};  // 0: the backend's own

  template <class Ask>
  void add(const std::string& query, const Options& options, const Ask& ask) {
    std::vector<std::string> first{query + " first", std::string(options.backend)};
    std::vector<std::string> again{query + " repeated", std::string(options.backend)};
    for (const std::uint32_t leaf_size : kLeafSizes) {
      const Asked asked = ask(TreeConfig{.leaf_size = leaf_size});
      const schedule::CostConstants constants = calibrated_constants(options.backend, leaf_size);
      const auto cell = [&](const Statistics& s) {
        return milliseconds(s.measured_seconds) + " (" + milliseconds(schedule::predict_seconds(s, constants)) + ")";
      };
      first.push_back(cell(asked.first)), again.push_back(cell(asked.again));
    }
    table_.add(std::move(first)), table_.add(std::move(again));
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "cost_leaves"); }

 private:
  Table table_{{"query", "backend", "default", "4", "8", "16", "32", "64", "128"}};
};

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  const int poses = arguments.quick ? 10 : 40, repeats = arguments.quick ? 1 : 5;
  Table constants({"backend", "leaf size", "C_b ns", "C_m ns", "C_s ns", "C_o ns", "C_v ns", "C_p ns", "C_u ns",
                   "C_t ns", "C_l ns", "C_e ns"});
  CostTable table;
  LeafTable leaves;
  for (Options options : {fast(), paper_way()}) {
    options.predict_cost = true;
    for (const std::uint32_t leaf_size : LeafTable::kLeafSizes) {
      const schedule::CostConstants measured = calibrated_constants(options.backend, leaf_size);
      std::vector<std::string> row{std::string(options.backend), leaf_size == 0 ? "default" : count(leaf_size)};
      for (const schedule::CostTerm& term : schedule::kCostTerms) row.push_back(nanoseconds(measured.*term.constant));
      constants.add(std::move(row));
    }
    // `ask(tree)`
    const auto add = [&](const std::string& name, const auto& ask) {
      const Asked asked = ask(TreeConfig{});
      table.add(name + " first", options, asked.first);
      table.add(name + " repeated", options, asked.again);
      leaves.add(name, options, ask);
    };
    const auto ask_posed = [&](const Subject& subject, Depth depth, int number) {
      return [&, depth, pairs = random_poses(make_mesh(subject.data), depth, number)](const TreeConfig& tree) {
        return ask_pairs(subject, pairs, repeats, options, tree);
      };
    };
    for (const Subject& subject : {torus_knot_subject(968), torus_knot_subject(9612), demo_subject("armadillo.off")})
      for (const Depth depth : {Depth::light, Depth::deep})
        add(subject.name + " of " + count(subject.data.triangle_count()) + " " + name_of(depth) + " (" +
                count(static_cast<std::uint64_t>(poses)) + " poses)",
            ask_posed(subject, depth, poses));
    for (const int stacks : {3, 5, 9, 17}) {  // questions that are asked once
      const Subject sphere{"sphere", scenes::uv_sphere(8, stacks)};
      leaves.add("sphere of " + count(sphere.data.triangle_count()) + " light", options,
                 ask_posed(sphere, Depth::light, 1));
    }
    for (const Assembly& assembly : assemblies()) {
      const io::Model model = read_model(assembly);
      add(assembly.name, [&](const TreeConfig& tree) {
        return ask_scene(
            repeats, [&] { return fresh_scene(model, tree); }, options);
      });
    }
    const scenes::PlacedScene boxes = scenes::flush_boxes(10, 10, 10);
    add("1000 flush boxes", [&](const TreeConfig& tree) {
      return ask_scene(
          repeats, [&] { return fresh_scene(boxes, tree); }, options);
    });
  }
  constants.write(arguments.folder, "cost_constants");
  table.write(arguments.folder);
  leaves.write(arguments.folder);
}

}  // namespace impinge::bench
