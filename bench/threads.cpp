// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What a second thread brings: one query on two threads, beside two threads that each ask queries of their own with
/// nothing in common. The latter is what this machine has to give.
#include <array>
#include <functional>
#include <memory>
#include <thread>

#include "bench/crowd.hpp"
#include "bench/ours.hpp"
#include "bench/rough_sheets.hpp"

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
}

}  // namespace impinge::bench
