// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// A small mesh against a large one, impinge and FCL: a tool over a terrain, a part in a room of a dozen triangles.
/// Yes or no, first contact, all contacts, and the distance.
#include <cmath>
#include <filesystem>
#include <limits>

#include "bench/contest.hpp"
#include "bench/ours.hpp"
#include "bench/peers/fcl_distance.hpp"
#include "impinge/collide.hpp"
#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

using Poses = std::vector<Pose>;

/// 20 by 20, waves of height 1 about z = 0, 2 n^2 triangles.
scenes::MeshData terrain(int n) {
  const double cell = 20.0 / n;
  return scenes::shifted(
      scenes::grid(n, n, cell, [cell](int i, int j) { return 0.5 * std::sin(cell * i) * std::cos(1.3 * cell * j); }),
      -10, -10, 0);
}

struct Large {
  std::string name;
  scenes::MeshData data;
};

/// One mesh in the terms of each library, trees built.
struct Body {
  explicit Body(const scenes::MeshData& data)
      : mesh(make_mesh(data)), fcl(data), fcl_native(data), fcl_distance(data), fcl_distance_native(data) {
    must(mesh.build_tree());
  }
  Mesh mesh;
  FclDebianMesh fcl;
  FclNativeMesh fcl_native;
  FclDistanceMesh<FclBuild::debian> fcl_distance;
  FclDistanceMesh<FclBuild::native> fcl_distance_native;
};

/// Turned in every way, somewhere over the middle of the large mesh, and lowered until its distance is `gap`; below 0,
/// until it is that much deeper than first touch.
Poses poses_over(const Body& large, const Body& small, double gap, double from, int count) {
  scenes::Random random(20011009);
  Poses poses;
  while (poses.size() < static_cast<std::size_t>(count)) {
    Pose pose = scenes::random_motion(random, 0);
    pose.t = {random.uniform(-4, 4), random.uniform(-4, 4), from};
    for (int step = 0; step < 60; ++step) {
      const double distance = must(impinge::distance(large.mesh, {}, small.mesh, pose)).distance;
      if (distance <= std::max(gap, 0.0) + 1e-6) break;
      pose.t[2] -= distance - std::max(gap, 0.0);
    }
    pose.t[2] += std::min(gap, 0.0);
    poses.push_back(pose);
  }
  return poses;
}

class UnequalTable {
 public:
  explicit UnequalTable(const Effort& effort) : effort_(effort) {}

  void add(const std::string& name, Body& large, Body& small, const char* place, const Poses& poses) {
    const std::vector<std::string> cells{name, count(large.mesh.triangle_count()), count(small.mesh.triangle_count()),
                                         place};
    // FCL has no call for yes or no alone: a request for one contact is what its users make.
    const auto add_contacts = [&](const char* question, std::size_t limit, const auto& ours) {
      add(cells, question,
          {{"impinge", ours},
           {"FCL", [&](std::size_t i) { large.fcl.collide({}, small.fcl, poses[i], limit); }},
           {"FCL native", [&](std::size_t i) { large.fcl_native.collide({}, small.fcl_native, poses[i], limit); }}},
          poses.size());
    };
    Workspace workspace;
    add_contacts("touches", 1,
                 [&](std::size_t i) { must(touches(large.mesh, {}, small.mesh, poses[i], {}, &workspace)); });
    for (const bool first : {true, false}) {
      Options options = fast();
      options.find = first ? Options::Find::first : Options::Find::all;
      Contacts answer;
      add_contacts(first ? "first contact" : "all contacts", first ? 1 : std::numeric_limits<std::size_t>::max(),
                   [&](std::size_t i) {
                     workspace.recycle(std::move(answer));
                     answer = must(collide(large.mesh, {}, small.mesh, poses[i], options, &workspace));
                   });
    }
    add(cells, "distance",
        {{"impinge",
          [&](std::size_t i) { must(distance(large.mesh, {}, small.mesh, poses[i], MeasureOptions{.threads = 1})); }},
         {"FCL", [&](std::size_t i) { large.fcl_distance.distance({}, small.fcl_distance, poses[i]); }},
         {"FCL native",
          [&](std::size_t i) { large.fcl_distance_native.distance({}, small.fcl_distance_native, poses[i]); }}},
        poses.size());
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "unequal"); }

 private:
  void add(std::vector<std::string> cells, const char* question, const std::vector<Contestant>& contestants,
           std::size_t questions) {
    const std::vector<Times> times = contest(contestants, questions, effort_);
    cells.emplace_back(question);
    for (const Times& one : times) cells.push_back(digits(1e6 * median(one.seconds)));
    for (const std::size_t fcl : {1, 2}) cells.push_back(digits(spread(times[fcl].ratio).median));
    table_.add(std::move(cells));
  }

  Effort effort_;
  Table table_{{"large mesh", "its triangles", "small mesh's", "place", "question", "impinge us", "FCL us",
                "FCL native us", "FCL / impinge", "FCL native / impinge"}};
};

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  UnequalTable table(arguments.quick ? Effort{2, 2, 0} : Effort{3, 7, 0.3});
  std::vector<Large> large{{"room", scenes::box({-10, -10, -4}, {10, 10, 6})}};
  for (const int n : arguments.quick ? std::vector{32} : std::vector{32, 100, 320, 700})
    large.push_back({"terrain", terrain(n)});
  std::vector<Body> small;
  for (const int slices : arguments.quick ? std::vector{20} : std::vector{8, 20, 60, 200})
    small.emplace_back(scenes::uv_sphere(slices, slices + 1, 0.4));
  for (const Large& one : large) {
    Body body(one.data);
    for (Body& tool : small) {
      const int poses = arguments.quick ? 4 : 20;
      table.add(one.name, body, tool, "far", poses_over(body, tool, 1.5, 3, poses));
      table.add(one.name, body, tool, "near", poses_over(body, tool, 0.05, 3, poses));
      table.add(one.name, body, tool, "touching", poses_over(body, tool, -0.02, 3, poses));
    }
  }
  table.write(arguments.folder);
}

}  // namespace impinge::bench
