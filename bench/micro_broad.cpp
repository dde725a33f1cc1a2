// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <optional>

#include "bench/micro.hpp"
#include "bench/support.hpp"
#include "broad/near_pairs.hpp"
#include "paper/sweep_and_prune.hpp"
#include "pipeline/mesh_state.hpp"
#include "scene/scene_view.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

/// Spheres of radius 1 in a cube, a few neighbours each. Every one moves on at its own speed, by up to a hundredth of
/// its size a frame along each axis, and turns back at the cube's sides.
class DriftingCrowd {
 public:
  explicit DriftingCrowd(int n, double speed = 1) : side_(3 * std::cbrt(n)), mesh_(make_mesh(scenes::uv_sphere(8, 6))) {
    scenes::Random random(6);
    for (const scenes::PlacedObject& object : scenes::scattered(random, scenes::uv_sphere(8, 6), n, side_).objects) {
      poses_.push_back(object.pose);
      const double most = 0.02 * speed;
      velocities_.push_back({random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)});
    }
    objects_.resize(poses_.size());
    place([](std::uint32_t, const scene::PlacedObject&) {});
  }

  void move() {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double &at = poses_[i].t[axis], &velocity = velocities_[i][axis];
        at += velocity;
        if (std::abs(at) > side_ / 2) velocity = -std::copysign(velocity, at);
      }
    }
  }
  /// Calls `placed(i, object)` for each.
  template <class Placed>
  void place(const Placed& placed) {
    for (std::uint32_t i = 0; i < poses_.size(); ++i) {
      objects_[i] = scene::place(mesh_.state().data, poses_[i], 0);
      placed(i, objects_[i]);
    }
  }
  [[nodiscard]] const std::vector<scene::PlacedObject>& objects() const { return objects_; }

 private:
  double side_;
  Mesh mesh_;
  std::vector<Pose> poses_;
  std::vector<std::array<double, 3>> velocities_;
  std::vector<scene::PlacedObject> objects_;
};

/// The parts of a frame.
struct FrameSeconds {
  double place = 0, update = 0, find = 0;
};

/// Frames of one crowd, measured when it has been moving for a while.
class Frames {
 public:
  explicit Frames(int n) : crowd_(n) {
    near_pairs_.reserve(crowd_.objects().size());
    for (int frame = 0; frame < 100; ++frame) next();
  }
  FrameSeconds next() {
    FrameSeconds seconds;
    crowd_.move();
    seconds.place = seconds_of([&] {
      crowd_.place([&](std::uint32_t i, const scene::PlacedObject& placed) { near_pairs_.place(i, placed); });
    });
    seconds.update = seconds_of([&] { near_pairs_.update(); });
    seconds.find = seconds_of([&] { near_pairs_.find({crowd_.objects()}, pairs_, scratch_); });
    return seconds;
  }

 private:
  DriftingCrowd crowd_;
  broad::NearPairs near_pairs_;
  broad::ObjectPairs pairs_;
  broad::NearPairs::Scratch scratch_;
};

/// `work` returns the seconds that count.
template <class Work>
void add(const std::string& name, const Work& work) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [work](benchmark::State& state) {
                                 for (auto _ : state) state.SetIterationTime(work());
                                 state.SetItemsProcessed(state.iterations());
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_frames(int n) {
  const std::string name = std::to_string(n) + " drifting spheres a frame: ";
  const auto frames = std::make_shared<std::optional<Frames>>();
  const auto add_part = [&](const std::string& what, double FrameSeconds::*part) {
    add(name + what, [n, frames, part] {
      if (!*frames) frames->emplace(n);
      return (*frames)->next().*part;
    });
  };
  add_part("bounds", &FrameSeconds::place);
  add_part("candidates updated", &FrameSeconds::update);
  add_part("pairs found", &FrameSeconds::find);
  const auto crowd = std::make_shared<DriftingCrowd>(n);
  add(name + "the paper's sweep",
      [crowd, borders = std::make_shared<paper::SweepAndPrune>(), pairs = std::make_shared<broad::ObjectPairs>()] {
        crowd->move();
        crowd->place([](std::uint32_t, const scene::PlacedObject&) {});
        return seconds_of([&] {
          borders->update({crowd->objects()});
          borders->find({crowd->objects()}, *pairs);
          benchmark::DoNotOptimize(pairs->data());
        });
      });
}

/// From nothing to the pairs.
void add_first(const std::string& name, const std::vector<scene::PlacedObject>& objects) {
  const auto shared = std::make_shared<const std::vector<scene::PlacedObject>>(objects);
  add(name + " from nothing", [shared] {
    return seconds_of([&] {
      broad::NearPairs near_pairs;
      broad::ObjectPairs pairs;
      broad::NearPairs::Scratch scratch;
      near_pairs.reserve(shared->size());
      for (std::uint32_t i = 0; i < shared->size(); ++i) near_pairs.place(i, (*shared)[i]);
      near_pairs.update();
      near_pairs.find({*shared}, pairs, scratch);
      benchmark::DoNotOptimize(pairs.data());
    });
  });
  add(name + " from nothing: the paper's sweep", [shared] {
    return seconds_of([&] {
      paper::SweepAndPrune borders;
      broad::ObjectPairs pairs;
      borders.update({*shared});
      borders.find({*shared}, pairs);
      benchmark::DoNotOptimize(pairs.data());
    });
  });
}

/// Thin pipes through the whole of a cube, at random, a third along each axis.
std::vector<scene::PlacedObject> crossing_pipes(int n) {
  static const MeshData some_mesh;
  scenes::Random random(3);
  const double half = 0.5 * std::sqrt(n / 3.0);
  std::vector<scene::PlacedObject> pipes(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    std::array<double, 3> center{random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
    std::array<double, 3> reach{0.01, 0.01, 0.01};
    const auto along = static_cast<std::size_t>(i % 3);
    center[along] = 0, reach[along] = half;
    const Vec3 c{center[0], center[1], center[2]}, r{reach[0], reach[1], reach[2]};
    scene::PlacedObject& pipe = pipes[static_cast<std::size_t>(i)];
    pipe.mesh = &some_mesh;
    pipe.box = {c - r, c + r};
    pipe.sphere = {c, norm(r) * (1 + 1e-12)};
  }
  return pipes;
}

}  // namespace

Table border_moves(int frames) {
  Table table({"speed", "moves a frame", "ms a frame"});
  for (const double speed : {0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    DriftingCrowd crowd(10'000, speed);
    paper::SweepAndPrune borders;
    borders.update({crowd.objects()});
    std::vector<double> seconds;
    std::uint64_t moves = 0;
    for (int frame = 0; frame < frames; ++frame) {
      crowd.move();
      crowd.place([](std::uint32_t, const scene::PlacedObject&) {});
      seconds.push_back(seconds_of([&] { borders.update({crowd.objects()}); }));
      moves += borders.counts().moves;
    }
    table.add({digits(speed), count(moves / static_cast<std::uint64_t>(frames)), milliseconds(median(seconds))});
  }
  return table;
}

void register_broad_benchmarks(int objects) {
  for (const int n : {1000, 10000, objects}) add_frames(n);
  add_first(std::to_string(objects) + " scattered spheres", DriftingCrowd(objects).objects());
  add_first("30000 pipes along three axes", crossing_pipes(30000));
}

}  // namespace impinge::bench
