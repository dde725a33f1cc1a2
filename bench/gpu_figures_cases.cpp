// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "bench/crowd.hpp"
#include "bench/gpu_figures.hpp"
#include "bench/mutual_motion.hpp"
#include "bench/rough_sheets.hpp"
#include "bench/support.hpp"
#include "impinge/collide.hpp"
#include "impinge/scene.hpp"
#include "scenes/contact_depth.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

constexpr std::uint64_t kSeed = 20080901;

std::uint64_t mixed(std::uint64_t sum, std::uint64_t value) {
  constexpr std::uint64_t kPrime = 0x100000001b3;  // FNV-1a's
  return (sum ^ value) * kPrime;
}

/// Triangles with the corners at `size` times (1, 0), (x, y) and (x, -y), turned and moved at random in one ball.
scenes::MeshData soup(int n, std::uint64_t seed, double size, double x, double y) {
  constexpr double kOffCenter = 0.3;
  scenes::Random random(seed);
  scenes::MeshData data;
  for (int i = 0; i < n; ++i) {
    const auto axes = scenes::random_rotation(random);
    std::array<double, 9> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const double center = random.uniform(-kOffCenter, kOffCenter);
      corners[k] = center + size * axes[3 * k];
      corners[3 + k] = center + size * (x * axes[3 * k] + y * axes[3 * k + 1]);
      corners[6 + k] = center + size * (x * axes[3 * k] - y * axes[3 * k + 1]);
    }
    data.add_triangle(corners);
  }
  return data;
}

Answer ask_poses(const Mesh& a, std::span<const Pose> poses_a, const Mesh& b, std::span<const Pose> poses_b,
                 const Options& options, Workspace& workspace) {
  Answer answer;
  Contacts contacts;
  answer.seconds =
      wall_seconds_of([&] { contacts = must(collide_poses(a, poses_a, b, poses_b, options, &workspace)); });
  answer.add(contacts, options.find);
  workspace.recycle(std::move(contacts));
  return answer;
}

/// One pair of meshes query after query, `poses` long.
Answer ask_each(const Mesh& a, const Mesh& b, std::span<const scenes::PosePair> poses, const Options& options,
                Workspace& workspace) {
  Answer answer;
  for (const auto& [pose_a, pose_b] : poses) {
    Contacts contacts;
    answer.seconds += wall_seconds_of([&] { contacts = must(collide(a, pose_a, b, pose_b, options, &workspace)); });
    answer.add(contacts, options.find);
    workspace.recycle(std::move(contacts));
  }
  return answer;
}

std::string twice(const Mesh& mesh) { return "2 x " + grouped(mesh.triangle_count()); }

Question pair_question(const Mesh& mesh, std::vector<scenes::PosePair> poses) {
  const int queries = static_cast<int>(poses.size());
  return {twice(mesh), queries, [mesh, poses = std::move(poses)](const Options& options, Workspace& workspace) {
            return ask_each(mesh, mesh, poses, options, workspace);
          }};
}

/// Two scenes in which the boxes of most pairs meet and few pairs touch, so that nearly all work is tests. Needles lie
/// on both sides of each other's planes: each pair takes all its tests of an edge and a triangle. A small triangle lies
/// on one side of most large ones, as neighbours do in a walk that goes well.
Case narrow(int n, bool are_needles) {
  return {.name = are_needles ? "narrow stage: needles" : "narrow stage: small triangles among large ones",
          .make =
              [=] {
                const auto mesh = [&](std::uint64_t seed, double size) {
                  return make_mesh(are_needles ? soup(n, seed, 1, -1, 0.01) : soup(n, seed, size, -0.5, 0.866));
                };
                const Mesh a = mesh(1, 1), b = mesh(2, 0.001);
                return Question{twice(a), 1, [a, b](const Options& options, Workspace& workspace) {
                                  return ask_each(a, b, {{scenes::PosePair{}}}, options, workspace);
                                }};
              },
          .is_rated = true};
}

/// The paper's experiment, its equation 6: two bodies in mutual motion, the time of a detection.
Case paper(int triangles, bool is_quick) {
  return {
      .name = "paper: mutual motion, a detection",
      .make =
          [=] { return pair_question(make_mesh(scenes::torus_knot_of(triangles)), mutual_motion(is_quick ? 67 : 1)); },
      .is_papers = true};
}

/// As bench_pairs has them.
constexpr double kGap = 0.01, kPastFirstTouch = 0.03, kCentersApart = 0.2;

Case light(int triangles) {
  return {.name = "pair of knots, light", .make = [=] {
            const Mesh mesh = make_mesh(scenes::torus_knot_of(triangles));
            scenes::Random random(kSeed);
            return pair_question(mesh, {must(scenes::near_first_touch(random, mesh, mesh, kPastFirstTouch))});
          }};
}

Case deep(int triangles) {
  return {.name = "pair of knots, deep", .make = [=] {
            const Mesh mesh = make_mesh(scenes::torus_knot_of(triangles));
            scenes::Random random(kSeed);
            return pair_question(mesh, {scenes::centers_apart(random, mesh, mesh, kCentersApart)});
          }};
}

Pose after(const Pose& motion, const Pose& pose) {
  Pose result = motion;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result.R[3 * i + j] = 0;
      for (std::size_t k = 0; k < 3; ++k) result.R[3 * i + j] += motion.R[3 * i + k] * pose.R[3 * k + j];
      result.t[i] += motion.R[3 * i + j] * pose.t[j];
    }
  }
  return result;
}

/// `n` poses of both bodies. A first touch takes long to find, so there are `relative` of them, in random motions.
Case many_poses(int triangles, int n, int relative, bool is_mixed, Options::Find find) {
  const std::string name = grouped(static_cast<std::uint64_t>(n)) + " poses, " +
                           (is_mixed ? "half near miss, half light" : "near miss") +
                           (find == Options::Find::first ? ", first contact" : ", all contacts");
  return {.name = name, .make = [=] {
            const Mesh mesh = make_mesh(scenes::torus_knot_of(triangles));
            scenes::Random random(kSeed);
            std::vector<scenes::PosePair> bases;
            for (int i = 0; i < relative; ++i) {
              const double depth = is_mixed && i % 2 == 1 ? kPastFirstTouch : -kGap;
              bases.push_back(must(scenes::near_first_touch(random, mesh, mesh, depth)));
            }
            std::vector<Pose> poses_a, poses_b;
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
              const Pose motion = scenes::random_motion(random, 1);
              const scenes::PosePair& base = bases[i % bases.size()];
              poses_a.push_back(after(motion, base.a)), poses_b.push_back(after(motion, base.b));
            }
            return Question{twice(mesh), 1, [=](Options options, Workspace& workspace) {
                              options.find = find;
                              return ask_poses(mesh, poses_a, mesh, poses_b, options, workspace);
                            }};
          }};
}

Case bodies(int n, int frames) {
  return {.name = grouped(static_cast<std::uint64_t>(n)) + " moving bodies, a frame", .make = [=] {
            struct Moving {
              Crowd crowd;
              Scene scene;
              std::vector<ObjectId> ids;
            };
            const auto moving = std::make_shared<Moving>(Moving{Crowd(n), {}, {}});
            const scenes::PlacedScene& placed = moving->crowd.scene();
            const Mesh mesh = make_mesh(placed.meshes.front());
            for (const auto& object : placed.objects) moving->ids.push_back(must(moving->scene.add(mesh, object.pose)));
            const auto triangles = static_cast<std::uint64_t>(n) * mesh.triangle_count();
            return Question{grouped(triangles), frames, [=](const Options& options, Workspace& workspace) {
                              Answer answer;
                              for (std::size_t f = 0; f < static_cast<std::size_t>(frames); ++f) {
                                const std::vector<Pose>& poses = moving->crowd.frame(f);
                                Contacts contacts;
                                answer.seconds += wall_seconds_of([&] {
                                  for (std::size_t i = 0; i < poses.size(); ++i)
                                    must(moving->scene.set_pose(moving->ids[i], poses[i]));
                                  must(moving->scene.update());
                                  contacts = must(moving->scene.collide(options, &workspace));
                                });
                                answer.add(contacts, options.find);
                                workspace.recycle(std::move(contacts));
                              }
                              return answer;
                            }};
          }};
}

/// Wrinkled sheets in one another.
Case sheets(int triangles, bool are_resident) {
  const char* const name = are_resident ? "sheets, meshes resident" : "sheets, from raw vertices";
  const auto make = [=] {
    const auto scene = std::make_shared<const scenes::PlacedScene>(rough_sheets(triangles));
    const std::string size = "2 x " + grouped(scene->meshes[0].triangle_count());
    if (are_resident) {
      const Mesh a = make_mesh(scene->meshes[0]), b = make_mesh(scene->meshes[1]);
      return Question{size, 1, [a, b](const Options& options, Workspace& workspace) {
                        return ask_each(a, b, {{scenes::PosePair{}}}, options, workspace);
                      }};
    }
    return Question{size, 1, [scene](const Options& options, Workspace&) {
                      Answer answer;
                      std::vector<Mesh> meshes;
                      Contacts contacts;
                      answer.seconds = wall_seconds_of([&] {
                        for (const scenes::MeshData& data : scene->meshes) meshes.push_back(make_mesh(data));
                        contacts = must(collide(meshes[0], {}, meshes[1], {}, options));
                      });
                      answer.add(contacts, options.find);
                      return answer;
                    }};
  };
  // Measured: 2.6 GB for two meshes of 7 million, raw numbers and answer included, on the CPU alone.
  return {.name = name, .make = make, .gigabytes = 1e-6 * triangles};
}

}  // namespace

void Answer::add(const Contacts& found, Options::Find find) {
  contacts += found.triangles.size();
  if (find == Options::Find::all) fingerprint = mixed(fingerprint, found.hash);
  for (std::size_t row = 0; row < found.objects.size(); ++row) {
    if (found.offsets[row] == found.offsets[row + 1]) continue;
    fingerprint = mixed(mixed(fingerprint, found.objects[row][0]), found.objects[row][1]);
  }
  statistics.push_back(found.statistics);
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
}

std::vector<Case> figure_cases(bool is_quick) {
  std::vector<Case> cases;
  for (const bool are_needles : {true, false}) cases.push_back(narrow(is_quick ? 512 : 8192, are_needles));
  for (const int triangles : kPaperSizes) cases.push_back(paper(triangles, is_quick));
  for (const int triangles : is_quick ? std::vector{70'000} : std::vector{70'000, 1'000'000}) {
    cases.push_back(light(triangles));
    cases.push_back(deep(triangles));
  }
  for (const int n : is_quick ? std::vector{100} : std::vector{10'000, 100'000})
    for (const bool is_mixed : {false, true})
      for (const auto find : {Options::Find::first, Options::Find::all})
        cases.push_back(many_poses(20'000, n, is_quick ? 10 : 1000, is_mixed, find));
  cases.push_back(bodies(is_quick ? 100 : 1000, is_quick ? 2 : 16));
  for (const bool are_resident : {false, true}) cases.push_back(sheets(is_quick ? 20'000 : 7'000'000, are_resident));
  return cases;
}

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::ptrdiff_t i = std::ssize(text) - 3; i > 0; i -= 3) text.insert(static_cast<std::size_t>(i), 1, ',');
  return text;
}

}  // namespace impinge::bench
