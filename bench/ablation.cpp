// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Leaf size times grid on or off: neither changes an answer, both change its time.
#include <optional>

#include "bench/assemblies.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/support.hpp"
#include "impinge/collide.hpp"

namespace impinge::bench {
namespace {

struct Setting {
  std::uint32_t leaf_size;
  bool grid;
  std::vector<double> light, deep, engine, engine_first;
};

class Ablation {
 public:
  Ablation(const scenes::MeshData& knot, int poses) : knot_(knot), engine_(read_model(assemblies().front())) {
    const Mesh mesh = make_mesh(knot);
    light_ = random_poses(mesh, Depth::light, poses);
    deep_ = random_poses(mesh, Depth::deep, poses);
  }

  /// One repeat of one setting.
  void run(Setting& setting) {
    const TreeConfig tree{.leaf_size = setting.leaf_size};
    const Options options{.threads = 1, .grid = setting.grid};
    const Mesh mesh = make_mesh(knot_, tree);
    for (const auto* poses : {&light_, &deep_}) {
      (void)mean_seconds(mesh, *poses, options);  // makes the nodes
      (poses == &light_ ? setting.light : setting.deep).push_back(mean_seconds(mesh, *poses, options));
    }
    const Scene scene = fresh_scene(engine_, tree);
    const auto query = [&] { check(must(scene.collide(options))); };
    setting.engine_first.push_back(seconds_of(query));
    setting.engine.push_back(seconds_of(query));
  }

 private:
  static double mean_seconds(const Mesh& mesh, const std::vector<scenes::PosePair>& poses, const Options& options) {
    const double seconds = seconds_of([&] {
      for (const auto& [pose_a, pose_b] : poses) (void)must(collide(mesh, pose_a, mesh, pose_b, options));
    });
    return seconds / static_cast<double>(poses.size());
  }

  void check(const Contacts& contacts) {
    if (!hash_) hash_ = contacts.hash;
    if (*hash_ != contacts.hash) fail("a setting changed the answer: the hash differs");
  }

  scenes::MeshData knot_;
  io::Model engine_;
  std::vector<scenes::PosePair> light_, deep_;
  std::optional<std::uint64_t> hash_;
};

void run(const Arguments& arguments) {
  constexpr std::size_t kKnot = 3;  // 7,590 triangles
  Ablation ablation(torus_knots()[kKnot].data, arguments.quick ? 10 : 20);
  const std::vector<std::uint32_t> leaf_sizes =
      arguments.quick ? std::vector<std::uint32_t>{2, 8, 32} : std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 64};
  std::vector<Setting> settings;
  for (const bool grid : {true, false})
    for (const std::uint32_t leaf_size : leaf_sizes) settings.push_back({leaf_size, grid, {}, {}, {}, {}});
  for (int repeat = 0; repeat < (arguments.quick ? 1 : 3); ++repeat)
    for (Setting& setting : settings) ablation.run(setting);

  Table table({"leaf size", "grid", "knot light ms", "knot deep ms", "engine ms", "engine first query ms"});
  for (const Setting& s : settings)
    table.add({std::to_string(s.leaf_size), s.grid ? "on" : "off", milliseconds(median(s.light)),
               milliseconds(median(s.deep)), milliseconds(median(s.engine)), milliseconds(median(s.engine_first))});
  table.write(arguments.folder, "ablation");
}

}  // namespace
}  // namespace impinge::bench

int main(int argc, char** argv) {
  const auto arguments = impinge::bench::parse_arguments(argc, argv);
  impinge::bench::pin_to_one_core();
  impinge::bench::run(arguments);
}
