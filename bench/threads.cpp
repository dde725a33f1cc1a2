// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What a second thread brings: one query on two threads, beside two threads that each ask queries of their own with
/// nothing in common. The latter is what this machine has to give.
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "bench/crowd.hpp"
#include "bench/ours.hpp"
#include "bench/rough_sheets.hpp"
#include "impinge/clash.hpp"
#include "scenes/contact_depth.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"

namespace impinge::bench {
namespace {

/// Something to ask again and again. `copy()` is the same work on meshes and trees of its own, ready to be asked.
struct Work {
  std::string name;
  std::function<std::function<void(int threads)>()> copy;
};

std::vector<Work> works(bool quick) {
  const auto crowd = std::make_shared<Crowd>(quick ? 1000 : 10'000);
  const auto sheets = std::make_shared<scenes::PlacedScene>(rough_sheets(quick ? 100'000 : 1'000'000));
  return {{count(crowd->scene().objects.size()) + " bodies",
           [crowd] {
             const auto scene = std::make_shared<Scene>();
             const Mesh mesh = make_mesh(crowd->scene().meshes.front());
             for (const Pose& pose : crowd->frame(0)) must(scene->add(mesh, pose));
             must(scene->update());
             return [scene](int threads) { (void)must(scene->collide(fast(threads))); };
           }},
          {"one pair of " + count(sheets->meshes[0].triangle_count()) + " triangles each", [sheets] {
             const auto meshes = std::make_shared<std::array<Mesh, 2>>(
                 std::array{make_mesh(sheets->meshes[0]), make_mesh(sheets->meshes[1])});
             return [meshes](int threads) { (void)must(collide((*meshes)[0], {}, (*meshes)[1], {}, fast(threads))); };
           }}};
}

constexpr std::uint64_t kSeed = 20080901;

/// Knots that just miss each other, and the same in half of the rows; what a robot of seven bodies may touch; verdicts;
/// a tree.
std::vector<Work> works_of_many_threads(bool quick) {
  const auto knot = std::make_shared<const Mesh>(make_mesh(scenes::torus_knot_of(20'000)));
  const auto poses = std::make_shared<std::array<std::vector<Pose>, 2>>();
  scenes::Random random(kSeed);
  for (int i = 0; i < (quick ? 10 : 1000); ++i) {
    const scenes::PosePair pair = must(scenes::near_first_touch(random, *knot, *knot, i % 2 == 0 ? -0.01 : 0.03));
    for (int k = 0; k < 10; ++k) (*poses)[0].push_back(pair.a), (*poses)[1].push_back(pair.b);
  }
  std::vector<Work> works;
  for (const auto find : {Options::Find::first, Options::Find::all})
    works.push_back({find == Options::Find::first ? "poses first contact" : "poses all contacts", [=] {
                       const auto workspace = std::make_shared<Workspace>();
                       return [=](int threads) {
                         Options options = fast(threads);
                         options.find = find;
                         workspace->recycle(
                             must(collide_poses(*knot, (*poses)[0], *knot, (*poses)[1], options, workspace.get())));
                       };
                     }});
  const auto crowd = std::make_shared<Crowd>(quick ? 100 : 1000);
  const auto scene = std::make_shared<Scene>();
  const Mesh body = make_mesh(crowd->scene().meshes.front());
  std::vector<ObjectId> ids;
  for (const Pose& pose : crowd->frame(0)) ids.push_back(must(scene->add(body, pose)));
  must(scene->update());
  ids.resize(7);
  std::vector<Pose> configurations;
  for (std::size_t i = 0; i < (quick ? 100u : 10'000u); ++i)
    for (std::size_t k = 0; k < ids.size(); ++k)
      configurations.push_back(crowd->frame(0)[(i * 7919 + k) % crowd->frame(0).size()]);
  works.push_back({"configurations of 7 bodies", [=] {
                     return [=](int threads) {
                       (void)must(scene->collide_configurations(ids, configurations, {.threads = threads}));
                     };
                   }});
  works.push_back({"verdicts on all pairs", [=] {
                     return [=](int threads) {
                       ClashOptions options;
                       options.threads = threads;
                       (void)must(find_clashes(*scene, options));
                     };
                   }});
  const auto sheets = std::make_shared<scenes::PlacedScene>(rough_sheets(quick ? 20'000 : 1'000'000));
  works.push_back({"mesh and tree of " + count(sheets->meshes[0].triangle_count()) + " triangles",
                   [=] { return [=](int threads) { must(make_mesh(sheets->meshes[0]).build_tree(threads)); }; }});
  return works;
}

/// What more threads bring, as far as the machine has them.
void measure_speedups(const Arguments& arguments) {
  const int repeats = arguments.quick ? 2 : 7, most = static_cast<int>(std::thread::hardware_concurrency());
  Table table({"work", "threads", "milliseconds", "speedup"});
  for (const Work& work : works_of_many_threads(arguments.quick)) {
    const auto ask = work.copy();
    ask(1);
    std::array<std::vector<double>, 5> seconds;
    for (int i = 0; i < repeats; ++i)
      for (std::size_t k = 0; k < seconds.size() && (1 << k) <= most; ++k)
        seconds[k].push_back(wall_seconds_of([&] { ask(1 << k); }));
    for (std::size_t k = 0; k < seconds.size() && (1 << k) <= most; ++k)
      table.add({work.name, std::to_string(1 << k), milliseconds(median(seconds[k])),
                 digits(median(seconds[0]) / median(seconds[k]))});
  }
  table.write(arguments.folder, "thread_counts");
}

}  // namespace

void bench_main(const Arguments& arguments) {
  const int repeats = arguments.quick ? 2 : 7;
  Table table({"work", "one_thread_ms", "two_threads_ms", "two_independent_ms", "speedup", "independent_speedup",
               "share", "share_low", "share_high"});
  for (const Work& work : works(arguments.quick)) {
    const auto ask = work.copy(), other = work.copy();
    for (const auto& warm : {ask, other}) warm(1);
    std::vector<double> one, two, independent, share;
    for (int i = 0; i < repeats; ++i) {
      one.push_back(wall_seconds_of([&] { ask(1); }));
      two.push_back(wall_seconds_of([&] { ask(2); }));
      independent.push_back(wall_seconds_of([&] {
        std::thread beside([&] { other(1); });
        ask(1);
        beside.join();
      }));
      share.push_back(independent.back() / (2 * two.back()));  // (one / two) / (2 one / independent)
    }
    const Spread shares = spread(share);
    table.add({work.name, milliseconds(median(one)), milliseconds(median(two)), milliseconds(median(independent)),
               digits(median(one) / median(two)), digits(2 * median(one) / median(independent)), digits(shares.median),
               digits(shares.low), digits(shares.high)});
  }
  table.write(arguments.folder, "threads");
  measure_speedups(arguments);
}

}  // namespace impinge::bench
