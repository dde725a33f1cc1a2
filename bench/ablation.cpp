// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Backend times partition times leaf size: none of them changes an answer, all of them change its time.
#include <optional>

#include "bench/assemblies.hpp"
#include "bench/mesh_pairs.hpp"
#include "bench/ours.hpp"

namespace impinge::bench {
namespace {

struct Setting {
  Options options;
  std::uint32_t leaf_size;
  std::vector<double> light, deep, engine, engine_first;  // seconds, a repeat each
};

class Ablation {
 public:
  Ablation(const Subject& subject, int poses) : data_(subject.data), engine_(read_model(assemblies().front())) {
    const Mesh mesh = make_mesh(data_);
    light_ = random_poses(mesh, Depth::light, poses);
    deep_ = random_poses(mesh, Depth::deep, poses);
  }

  /// One repeat of one setting.
  void run(Setting& setting) {
    const TreeConfig tree{.leaf_size = setting.leaf_size};
    const Mesh mesh = make_mesh(data_, tree);
    for (const auto* poses : {&light_, &deep_}) {
      (void)mean_seconds(mesh, *poses, setting.options);  // makes the nodes
      (poses == &light_ ? setting.light : setting.deep).push_back(mean_seconds(mesh, *poses, setting.options));
    }
    const Scene scene = fresh_scene(engine_, tree);
    const auto query = [&] { check(must(scene.collide(setting.options))); };
    setting.engine_first.push_back(seconds_of(query));
    setting.engine.push_back(seconds_of(query));
  }

 private:
  double mean_seconds(const Mesh& mesh, const std::vector<scenes::PosePair>& poses, const Options& options) {
    const double seconds = seconds_of([&] {
      for (const auto& [a, b] : poses) workspace_.recycle(must(collide(mesh, a, mesh, b, options, &workspace_)));
    });
    return seconds / static_cast<double>(poses.size());
  }

  void check(const Contacts& contacts) {
    if (!hash_) hash_ = contacts.hash;
    if (*hash_ != contacts.hash) fail("a setting changed the answer: the hash differs");
  }

  scenes::MeshData data_;
  io::Model engine_;
  std::vector<scenes::PosePair> light_, deep_;
  std::optional<std::uint64_t> hash_;
  Workspace workspace_;
};

const char* name_of(Partition partition) {
  switch (partition) {
    case Partition::grid:
      return "grid";
    case Partition::sweep:
      return "sweep";
    case Partition::all:
      return "all";
    case Partition::automatic:
      break;
  }
  return "automatic";
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  Ablation ablation(demo_subject("armadillo.off"), arguments.quick ? 4 : 12);
  const std::vector<std::uint32_t> leaf_sizes =
      arguments.quick ? std::vector<std::uint32_t>{8, 32} : std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 64};
  // Without any partition large leaves take minutes, and show nothing that small ones do not.
  constexpr std::uint32_t kLargestUnparted = 8;
  std::vector<Setting> settings;
  for (Options options : {fast(), paper_way()})
    for (const Partition partition : {Partition::grid, Partition::sweep, Partition::all})
      for (const std::uint32_t leaf_size : leaf_sizes) {
        if (partition == Partition::all && leaf_size > kLargestUnparted) continue;
        options.partition = partition;
        settings.push_back({options, leaf_size, {}, {}, {}, {}});
      }
  for (int repeat = 0; repeat < (arguments.quick ? 1 : 3); ++repeat)
    for (Setting& setting : settings) ablation.run(setting);

  Table table({"backend", "partition", "leaf_size", "light_ms", "deep_ms", "engine_ms", "engine_first_ms"});
  for (const Setting& s : settings)
    table.add({std::string(s.options.backend), name_of(s.options.partition), std::to_string(s.leaf_size),
               milliseconds(median(s.light)), milliseconds(median(s.deep)), milliseconds(median(s.engine)),
               milliseconds(median(s.engine_first))});
  table.write(arguments.folder, "ablation");
}

}  // namespace impinge::bench
