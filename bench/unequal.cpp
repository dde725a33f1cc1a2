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

Mesh with_tree(const scenes::MeshData& data) {
  Mesh mesh = make_mesh(data);
  must(mesh.build_tree());
  return mesh;
}

/// A mesh with FCL's tree for one kind of question, by either build.
template <template <FclBuild> class FclTree>
struct FclTrees {
  explicit FclTrees(const scenes::MeshData& data) : debian(data), native(data) {}
  FclTree<FclBuild::debian> debian;
  FclTree<FclBuild::native> native;
};
using ContactTrees = FclTrees<FclMesh>;
using DistanceTrees = FclTrees<FclDistanceMesh>;

struct Small {
  explicit Small(const scenes::MeshData& data) : mesh(with_tree(data)), contact(data), distance(data) {}
  Mesh mesh;
  ContactTrees contact;
  DistanceTrees distance;
};

/// Turned in every way, somewhere over the middle of the large mesh, and lowered until its distance is `gap`; below 0,
/// until it is that much deeper than first touch.
Poses poses_over(const Mesh& large, const Mesh& small, double gap, double from, int count) {
  scenes::Random random(20011009);
  Poses poses;
  while (poses.size() < static_cast<std::size_t>(count)) {
    Pose pose = scenes::random_motion(random, 0);
    pose.t = {random.uniform(-4, 4), random.uniform(-4, 4), from};
    for (int step = 0; step < 60; ++step) {
      const double apart = must(distance(large, {}, small, pose)).distance;
      if (apart <= std::max(gap, 0.0) + 1e-6) break;
      pose.t[2] -= apart - std::max(gap, 0.0);
    }
    pose.t[2] += std::min(gap, 0.0);
    poses.push_back(pose);
  }
  return poses;
}

struct Case {
  const char* place;
  Small& small;
  Poses poses;
};

class UnequalTable {
 public:
  explicit UnequalTable(const Effort& effort) : effort_(effort) {}

  /// FCL's trees for one kind of question at a time: with five million triangles the program holds 7 GB at most.
  void add(const std::string& name, const scenes::MeshData& data, std::vector<Small>& small, int poses) {
    const Mesh large = with_tree(data);
    std::vector<Case> cases;
    for (Small& one : small) {
      cases.push_back({"far", one, poses_over(large, one.mesh, 1.5, 3, poses)});
      cases.push_back({"near", one, poses_over(large, one.mesh, 0.05, 3, poses)});
      cases.push_back({"touching", one, poses_over(large, one.mesh, -0.02, 3, poses)});
    }
    {
      ContactTrees trees(data);
      for (const Case& one : cases) add_contacts(name, large, trees, one);
    }
    DistanceTrees trees(data);
    for (const Case& one : cases) add_distance(name, large, trees, one);
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "unequal"); }

 private:
  void add_contacts(const std::string& name, const Mesh& large, ContactTrees& fcl, const Case& asked) {
    Small& small = asked.small;
    const Poses& poses = asked.poses;
    // FCL has no call for yes or no alone: a request for one contact is what its users make.
    const auto add_contest = [&](const char* question, std::size_t limit, const auto& ours) {
      add_row(name, large, asked, question,
              {{"impinge", ours},
               {"FCL", [&](std::size_t i) { fcl.debian.collide({}, small.contact.debian, poses[i], limit); }},
               {"FCL native", [&](std::size_t i) { fcl.native.collide({}, small.contact.native, poses[i], limit); }}});
    };
    Workspace workspace;
    add_contest("touches", 1, [&](std::size_t i) { must(touches(large, {}, small.mesh, poses[i], {}, &workspace)); });
    for (const bool first : {true, false}) {
      Options options = fast();
      options.find = first ? Options::Find::first : Options::Find::all;
      Contacts answer;
      add_contest(first ? "first contact" : "all contacts", first ? 1 : std::numeric_limits<std::size_t>::max(),
                  [&](std::size_t i) {
                    workspace.recycle(std::move(answer));
                    answer = must(collide(large, {}, small.mesh, poses[i], options, &workspace));
                  });
    }
  }
  void add_distance(const std::string& name, const Mesh& large, DistanceTrees& fcl, const Case& asked) {
    Small& small = asked.small;
    const Poses& poses = asked.poses;
    add_row(name, large, asked, "distance",
            {{"impinge",
              [&](std::size_t i) { must(distance(large, {}, small.mesh, poses[i], MeasureOptions{.threads = 1})); }},
             {"FCL", [&](std::size_t i) { fcl.debian.distance({}, small.distance.debian, poses[i]); }},
             {"FCL native", [&](std::size_t i) { fcl.native.distance({}, small.distance.native, poses[i]); }}});
  }
  void add_row(const std::string& name, const Mesh& large, const Case& asked, const char* question,
               const std::vector<Contestant>& contestants) {
    const std::vector<Times> times = contest(contestants, asked.poses.size(), effort_);
    std::vector<std::string> cells{name, count(large.triangle_count()), count(asked.small.mesh.triangle_count()),
                                   asked.place, question};
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
  std::vector<Small> small;
  for (const int slices : arguments.quick ? std::vector{20} : std::vector{8, 20, 60, 200})
    small.emplace_back(scenes::uv_sphere(slices, slices + 1, 0.4));
  const int poses = arguments.quick ? 4 : 20;
  table.add("room", scenes::box({-10, -10, -4}, {10, 10, 6}), small, poses);
  for (const int n : arguments.quick ? std::vector{32} : std::vector{32, 100, 320, 700, 1600})
    table.add("terrain", terrain(n), small, poses);
  table.write(arguments.folder);
}

}  // namespace impinge::bench
