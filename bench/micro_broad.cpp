// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "bench/micro.hpp"
#include "bench/support.hpp"
#include "broad/sweep_and_prune.hpp"
#include "mesh_state.hpp"
#include "scene/scene_view.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

/// A scene, and the same one a moment later: everything has moved by a hundredth of its size.
struct Crowd {
  Mesh mesh;
  std::array<std::vector<scene::PlacedObject>, 2> frames;

  Crowd(const scenes::PlacedScene& placed, std::uint64_t seed) : mesh(make_mesh(placed.meshes.front())) {
    scenes::Random random(seed);
    const double step = 0.02 * mesh.sphere_radius();
    for (const scenes::PlacedObject& object : placed.objects) {
      Pose pose = object.pose;
      frames[0].push_back(scene::place(mesh.state().data, pose, object.group));
      for (double& t : pose.t) t += random.uniform(-step, step);
      frames[1].push_back(scene::place(mesh.state().data, pose, object.group));
    }
  }
  [[nodiscard]] scene::SceneView frame(std::size_t i) const { return {frames[i % 2]}; }
};

void count_items(benchmark::State& state) { state.SetItemsProcessed(state.iterations()); }

void add_crowd(const std::string& name, const scenes::PlacedScene& placed) {
  const auto crowd = std::make_shared<const Crowd>(placed, 5);
  benchmark::RegisterBenchmark((name + ": borders sorted").c_str(), [crowd](benchmark::State& state) {
    for (auto _ : state) {
      broad::SweepAndPrune borders;
      borders.update(crowd->frame(0));
      benchmark::DoNotOptimize(&borders);
    }
    count_items(state);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((name + ": borders repaired").c_str(), [crowd](benchmark::State& state) {
    broad::SweepAndPrune borders;
    borders.update(crowd->frame(0));
    std::size_t frame = 0;
    for (auto _ : state) borders.update(crowd->frame(++frame));
    count_items(state);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((name + ": pairs found").c_str(), [crowd](benchmark::State& state) {
    broad::SweepAndPrune borders;
    borders.update(crowd->frame(0));
    for (auto _ : state) benchmark::DoNotOptimize(borders.find(crowd->frame(0)));
    count_items(state);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_broad_benchmarks(int objects) {
  scenes::Random random(6);
  const double side = 3 * std::cbrt(objects);  // of spheres of radius 1: a few neighbours each
  add_crowd(std::to_string(objects) + " spheres in a cube",
            scenes::scattered(random, scenes::uv_sphere(8, 6), objects, side));
  add_crowd(std::to_string(objects) + " pipes along an axis", scenes::pipe_row(objects, 8));
}

}  // namespace impinge::bench
