// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// An arm of seven links among obstacles at random configurations, as a planner samples them: yes or no, and the least
/// distance, against FCL's broad-phase managers; the cost of a call where nothing is near; and rooms and tables of 12
/// triangles. With IMPINGE_PLANNER_CONFIGURATIONS set to a number, it only compares the yes or no of so many.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "bench/contest.hpp"
#include "bench/ours.hpp"
#include "bench/peers/fcl_crowd.hpp"
#include "bench/peers/fcl_distance.hpp"
#include "impinge/collide.hpp"
#include "impinge/measures.hpp"
#include "impinge/scene.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

using Poses = std::vector<Pose>;

constexpr std::size_t kLinks = 7;
constexpr int kObstacles = 200;
constexpr double kLink = 0.25;  ///< its length, joint to joint

/// `by` in the frame of `pose`.
Pose placed_in(const Pose& pose, const Pose& by) {
  Pose result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result.R[3 * i + j] = pose.R[3 * i] * by.R[j] + pose.R[3 * i + 1] * by.R[3 + j] + pose.R[3 * i + 2] * by.R[6 + j];
    result.t[i] = pose.R[3 * i] * by.t[0] + pose.R[3 * i + 1] * by.t[1] + pose.R[3 * i + 2] * by.t[2] + pose.t[i];
  }
  return result;
}

/// Appends the links' poses: joints turn about z and y in turns, each link stands on the one before.
void append_arm(const std::array<double, kLinks>& angles, Poses& poses) {
  Pose joint;
  for (std::size_t i = 0; i < kLinks; ++i) {
    const double c = std::cos(angles[i]), s = std::sin(angles[i]);
    joint = placed_in(joint, i % 2 == 0 ? Pose{.R{c, -s, 0, s, c, 0, 0, 0, 1}} : Pose{.R{c, 0, s, 0, 1, 0, -s, 0, c}});
    poses.push_back(joint);
    joint = placed_in(joint, {.t{0, 0, kLink}});
  }
}

/// Seven links of 836 triangles; those with one between them may touch.
struct Arm {
  Arm() {
    links.meshes = {scenes::pipe(22, 18, 0.045, kLink, true)};
    links.objects.resize(kLinks);
    for (std::uint32_t i = 0; i < kLinks; ++i)
      for (std::uint32_t k = i + 2; k < kLinks; ++k) pairs.push_back({i, k});
  }
  scenes::PlacedScene links;
  std::vector<std::array<std::uint32_t, 2>> pairs;
};

/// Torus knots of 968 triangles and `size` across, around the arm's foot but not nearer than `clear`.
scenes::PlacedScene obstacles(double size, double clear) {
  scenes::Random random(20240613);
  scenes::PlacedScene scene;
  const double scale = size / 6.8;  // a knot's bounding-sphere diameter
  scene.meshes = {scenes::scaled(scenes::torus_knot_of(968), scale, scale, scale)};
  while (scene.objects.size() < kObstacles) {
    Pose pose = scenes::random_motion(random, 2);
    if (std::hypot(pose.t[0], pose.t[1], pose.t[2]) > clear) scene.objects.push_back({.mesh = 0, .pose = pose});
  }
  return scene;
}

/// The same in impinge's terms.
class OurRobot {
 public:
  OurRobot(const scenes::PlacedScene& obstacles, const Arm& arm) {
    const Mesh obstacle = make_mesh(obstacles.meshes.front()), link = make_mesh(arm.links.meshes.front());
    must(obstacle.build_tree()), must(link.build_tree());
    constexpr std::uint32_t kStanding = 1;
    for (const scenes::PlacedObject& object : obstacles.objects) must(scene.add(obstacle, object.pose, kStanding));
    for (std::size_t i = 0; i < kLinks; ++i) links.push_back(must(scene.add(link)));
    for (std::size_t i = 0; i + 1 < kLinks; ++i) must(scene.ignore(links[i], links[i + 1]));
    must(scene.update());
  }
  bool touches(std::span<const Pose> poses) {
    must(scene.set_poses(links, poses));
    must(scene.update(1));
    return must(scene.touches_any({.threads = 1}));
  }
  double distance(std::span<const Pose> poses) {
    must(scene.set_poses(links, poses));
    return must(scene.distance(MeasureOptions{.threads = 1}))->nearest.distance;
  }

  Scene scene;
  std::vector<ObjectId> links;
};

class PlannerTable {
 public:
  explicit PlannerTable(const Effort& effort) : effort_(effort) {}

  /// impinge comes first among the contestants; the quickest of the others is what it is held against. A row for
  /// `questions` questions of `parts` parts each.
  void add(const std::string& scene, const std::string& work, const std::vector<Contestant>& contestants,
           std::size_t questions, double must, std::size_t parts = 1) {
    const std::vector<Times> times = contest(contestants, questions, effort_);
    std::size_t best = 1;
    for (std::size_t c = 2; c < times.size(); ++c)
      if (median(times[c].seconds) < median(times[best].seconds)) best = c;
    const Spread ratio = spread(times[best].ratio);
    const auto microseconds = [&](std::size_t c) {
      return digits(1e6 * median(times[c].seconds) / static_cast<double>(parts));
    };
    table_.add({scene, work, count(questions * parts), microseconds(0), contestants[best].name, microseconds(best),
                digits(ratio.median), digits(ratio.low), digits(ratio.high), digits(must)});
  }
  void write(const std::filesystem::path& folder) const { table_.write(folder, "planner"); }

 private:
  Effort effort_;
  Table table_{
      {"scene", "work", "questions", "impinge_us", "fcl", "fcl_us", "ratio", "ratio_low", "ratio_high", "must_ratio"}};
};

void check_distance(double ours, double theirs) {
  if (!(std::abs(ours - theirs) <= 1e-6)) fail("impinge and FCL do not agree about a distance");
}

/// So many random configurations of the arm.
Poses random_configurations(scenes::Random& random, std::size_t count) {
  Poses poses;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, kLinks> angles;
    for (double& angle : angles) angle = random.uniform(-2, 2);
    append_arm(angles, poses);
  }
  return poses;
}

/// The yes or no of so many configurations, by both of impinge's calls and by FCL; nothing is timed.
void compare_answers(const std::string& name, double size, double clear, std::size_t count) {
  const Arm arm;
  const scenes::PlacedScene around = obstacles(size, clear);
  OurRobot ours(around, arm);
  FclRobot tree(FclManager::tree, around, arm.links, arm.pairs);
  scenes::Random random(4242);
  constexpr std::size_t kAtOnce = 1000;
  std::size_t touching = 0, done = 0;
  for (; done < count; done += kAtOnce) {
    const Poses poses = random_configurations(random, kAtOnce);
    const auto batch = must(ours.scene.collide_configurations(ours.links, poses, {.threads = 1}));
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      const auto at = std::span<const Pose>(poses).subspan(kLinks * i, kLinks);
      const bool touches = batch.touches[i] != 0;
      touching += touches ? 1 : 0;
      if (ours.touches(at) != touches || tree.touches(at) != touches)
        fail("impinge and FCL do not agree about configuration " + std::to_string(done + i) + " of " + name);
    }
  }
  std::printf("%s: the same yes or no of %zu configurations, %zu of them in contact\n", name.c_str(), done, touching);
}

/// The arm among obstacles of one size.
void add_robot(const std::string& name, double size, double clear, std::size_t questions, PlannerTable& table) {
  const Arm arm;
  const scenes::PlacedScene around = obstacles(size, clear);
  OurRobot ours(around, arm);
  FclRobot tree(FclManager::tree, around, arm.links, arm.pairs),
      array(FclManager::tree_array, around, arm.links, arm.pairs),
      sweep(FclManager::sweep_and_prune, around, arm.links, arm.pairs);

  scenes::Random random(42);
  const Poses poses = random_configurations(random, questions);
  const auto at = [&](std::size_t i) { return std::span<const Pose>(poses).subspan(kLinks * i, kLinks); };
  const auto batch = must(ours.scene.collide_configurations(ours.links, poses, {.threads = 1}));
  const auto distances = must(ours.scene.distance_configurations(ours.links, poses, MeasureOptions{.threads = 1}));
  std::size_t touching = 0;
  for (std::size_t i = 0; i < questions; ++i) {
    const bool touches = batch.touches[i] != 0;
    touching += touches ? 1 : 0;
    if (ours.touches(at(i)) != touches || tree.touches(at(i)) != touches || array.touches(at(i)) != touches ||
        sweep.touches(at(i)) != touches)
      fail("impinge and FCL do not agree about configuration " + std::to_string(i));
    const double distance = ours.distance(at(i));
    check_distance(distance, distances[i]->nearest.distance);
    check_distance(distance, tree.distance(at(i)));
  }
  const std::string scene =
      name + " (" + percent(static_cast<double>(touching), static_cast<double>(questions)) + " in contact)";
  const auto fcl = [&](auto ask) {
    return std::vector<Contestant>{{"tree", [&tree, ask](std::size_t i) { ask(tree, i); }},
                                   {"tree array", [&array, ask](std::size_t i) { ask(array, i); }},
                                   {"sweep and prune", [&sweep, ask](std::size_t i) { ask(sweep, i); }}};
  };
  const auto with = [](Contestant first, std::vector<Contestant> others) {
    others.insert(others.begin(), std::move(first));
    return others;
  };
  table.add(scene, "set_poses; update; touches_any",
            with({"impinge", [&](std::size_t i) { ours.touches(at(i)); }},
                 fcl([&](FclRobot& robot, std::size_t i) { robot.touches(at(i)); })),
            questions, 4);
  table.add(scene, "collide_configurations",
            with({"impinge",
                  [&](std::size_t) { must(ours.scene.collide_configurations(ours.links, poses, {.threads = 1})); }},
                 fcl([&](FclRobot& robot, std::size_t) {
                   for (std::size_t i = 0; i < questions; ++i) robot.touches(at(i));
                 })),
            1, 5, questions);
  const auto distance = fcl([&](FclRobot& robot, std::size_t i) { robot.distance(at(i)); });
  const std::size_t some = questions / 8;  // FCL takes some milliseconds each
  table.add(scene, "set_poses; distance", with({"impinge", [&](std::size_t i) { ours.distance(at(i)); }}, distance),
            some, 6);
  table.add(scene, "distance_configurations",
            with({"impinge",
                  [&](std::size_t) {
                    must(ours.scene.distance_configurations(ours.links, std::span(poses).first(kLinks * some),
                                                            MeasureOptions{.threads = 1}));
                  }},
                 fcl([&](FclRobot& robot, std::size_t) {
                   for (std::size_t i = 0; i < some; ++i) robot.distance(at(i));
                 })),
            1, 6, some);
  table.add(scene, "set_poses of 7 among 200",
            with({"impinge", [&](std::size_t i) { must(ours.scene.set_poses(ours.links, at(i))); }},
                 fcl([&](FclRobot& robot, std::size_t i) { robot.place(at(i)); })),
            questions, 1);
}

/// Two meshes, the first of which stands still.
void add_pair(const std::string& name, const scenes::MeshData& standing, const scenes::MeshData& moving,
              const Poses& poses, double must_touches, double must_distance, PlannerTable& table) {
  const Mesh a = make_mesh(standing), b = make_mesh(moving);
  must(a.build_tree()), must(b.build_tree());
  FclDebianMesh fcl_a(standing), fcl_b(moving);
  FclDistanceMesh<FclBuild::debian> near_a(standing), near_b(moving);
  Options options = fast();
  options.find = Options::Find::first;
  Workspace workspace;
  Contacts answer;
  const auto ours = [&](std::size_t i) {
    workspace.recycle(std::move(answer));
    answer = must(collide(a, {}, b, poses[i], options, &workspace));
  };
  const auto distance_of = [&](std::size_t i) {
    return must(distance(a, {}, b, poses[i], MeasureOptions{.threads = 1}, &workspace)).distance;
  };
  const auto fcls = [&](std::size_t i) { return fcl_a.collide({}, fcl_b, poses[i], 1) > 0; };
  const auto touch = [&](std::size_t i) { return must(touches(a, {}, b, poses[i], {}, &workspace)); };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ours(i);
    if (answer.objects.empty() == fcls(i) || touch(i) != fcls(i)) fail(name + ": impinge and FCL do not agree");
    check_distance(distance_of(i), std::max(0.0, near_a.distance({}, near_b, poses[i])));
  }
  const Contestant fcl{"mesh", [&](std::size_t i) { fcls(i); }};
  table.add(name, "touches", {{"impinge", [&](std::size_t i) { touch(i); }}, fcl}, poses.size(), must_touches);
  table.add(name, "first contact", {{"impinge", ours}, fcl}, poses.size(), 0);
  if (must_distance > 0)
    table.add(name, "distance",
              {{"impinge", [&](std::size_t i) { distance_of(i); }},
               {"mesh", [&](std::size_t i) { near_a.distance({}, near_b, poses[i]); }}},
              poses.size(), must_distance);
}

/// A link at `count` random places in a box.
Poses places(const std::array<double, 3>& low, const std::array<double, 3>& high, int count) {
  scenes::Random random(7);
  Poses poses;
  for (int i = 0; i < count; ++i) {
    Pose pose = scenes::random_motion(random, 0);
    for (std::size_t k = 0; k < 3; ++k) pose.t[k] = random.uniform(low[k], high[k]);
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  if (const char* configurations = std::getenv("IMPINGE_PLANNER_CONFIGURATIONS")) {
    compare_answers("dense", 0.53, 0.45, std::stoul(configurations));
    compare_answers("sparse", 0.14, 0.45, std::stoul(configurations));
    return;
  }
  PlannerTable table(arguments.quick ? Effort{2, 2, 0} : Effort{5, 9, 3});
  const std::size_t questions = arguments.quick ? 128 : 1024;
  add_robot("dense", 0.53, 0.45, questions, table);
  add_robot("sparse", 0.14, 0.45, questions, table);
  const int count = arguments.quick ? 16 : 200;
  const scenes::MeshData link = Arm().links.meshes.front();
  add_pair("two links far apart", link, link, places({2, 2, 2}, {3, 3, 3}, count), 1, 0, table);
  add_pair("a link in a room of 12", scenes::box({-2, -2, 0}, {2, 2, 3}), link,
           places({-1.9, -1.9, 0.1}, {1.9, 1.9, 2.9}, count), 2, 2, table);
  add_pair("a link over a table of 12", scenes::box({-1, -0.5, 0.7}, {1, 0.5, 0.74}), link,
           places({-1, -0.5, 0.75}, {1, 0.5, 1.25}, count), 2, 2, table);
  table.write(arguments.folder);
}

}  // namespace impinge::bench
