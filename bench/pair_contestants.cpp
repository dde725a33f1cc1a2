// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/pair_contestants.hpp"

#include <cstdlib>

#include "bench/device.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/common.hpp"
#ifdef IMPINGE_BENCH_RAPID
#include "bench/peers/rapid.hpp"
#endif

namespace impinge::bench {
namespace {

using Poses = std::vector<scenes::PosePair>;

std::vector<TrianglePair> some_pair_if(bool touches) {
  if (touches) return {{0, 0}};
  return {};
}

/// With a workspace, as a caller who asks again and again would. A device's work must not be done by the CPU in its
/// stead, which a warning tells.
Contestant impinge_contestant(const std::string& name, const Copies& copies, const Poses& poses,
                              const Options& options) {
  struct State {
    Workspace workspace;
    Contacts answer;
  };
  const bool first = options.find == Options::Find::first;
  const auto state = std::make_shared<State>();
  return {name,
          [state, &copies, &poses, options](std::size_t i) {
            state->workspace.recycle(std::move(state->answer));
            state->answer = must(collide(copies.mesh, poses[i].a, copies.mesh, poses[i].b, options, &state->workspace));
          },
          [state, first, name] {
            if (!state->answer.warnings.empty()) fail(name + ": " + state->answer.warnings.front());
            return first ? some_pair_if(!state->answer.triangles.empty()) : state->answer.triangles;
          }};
}

/// FCL's or RAPID's model, against itself.
template <class Tree>
Contestant tree_contestant(const char* name, Tree& tree, const Poses& poses, bool first) {
  const std::size_t limit = first ? 1 : std::numeric_limits<std::size_t>::max();
  return {name, [&, limit](std::size_t i) { tree.collide(poses[i].a, tree, poses[i].b, limit); },
          [&, first] { return first ? some_pair_if(!tree.pairs().empty()) : tree.pairs(); }};
}

/// The same with a tree of its own, made now.
template <class Tree>
Contestant new_tree_contestant(const char* name, const Copies& copies, const Poses& poses, bool first) {
  const auto tree = std::make_shared<Tree>(copies.data);
  const Contestant contestant = tree_contestant(name, *tree, poses, first);
  return {name, [tree, contestant](std::size_t i) { contestant.ask(i); }, [contestant] { return contestant.pairs(); }};
}

/// The second body's boxes are built anew for each pose, in the frame of the first, before anything is timed.
Contestant embree_query_alone(Copies& copies, const Poses& poses) {
  const auto placed = std::make_shared<std::vector<EmbreeBody>>();
  for (const auto& [a, b] : poses) placed->emplace_back(copies.data, relative(a, b), EmbreeBody::Motion::fixed);
  return {"Embree query alone", [&copies, placed](std::size_t i) { copies.embree_still.collide((*placed)[i]); },
          [&copies] { return copies.embree_still.pairs(); }};
}

Contestant embree_with_refit(Copies& copies, const Poses& poses) {
  return {"Embree with refit",
          [&](std::size_t i) {
            copies.embree_moving.move(relative(poses[i].a, poses[i].b));
            copies.embree_still.collide(copies.embree_moving);
          },
          [&copies] { return copies.embree_still.pairs(); }};
}

/// World triangles of both bodies and the tree of the first stand ready for each pose: exact on the very numbers that
/// impinge answers on.
Contestant cgal_query_alone(const Copies& copies, const Poses& poses, bool first) {
  struct Placed {
    std::vector<CgalBody> a, b;
    std::vector<TrianglePair> answer;
  };
  const auto placed = std::make_shared<Placed>();
  for (const auto& [a, b] : poses) {
    placed->a.emplace_back(copies.data, a).build_tree();
    placed->b.emplace_back(copies.data, b);
  }
  if (first)
    return {"CGAL query alone",
            [placed](std::size_t i) { placed->answer = some_pair_if(placed->a[i].touches(placed->b[i])); },
            [placed] { return placed->answer; }};
  const auto last = std::make_shared<std::size_t>(0);
  return {"CGAL query alone",
          [placed, last](std::size_t i) {
            placed->a[i].collide(placed->b[i]);
            *last = i;
          },
          [placed, last] { return placed->a[*last].pairs(); }};
}

}  // namespace

Copies::Copies(const scenes::MeshData& numbers)
    : data(numbers),
      mesh(make_mesh(numbers)),
      fcl(numbers),
      fcl_native(numbers),
      embree_still(numbers, {}, EmbreeBody::Motion::fixed),
      embree_moving(numbers, {}, EmbreeBody::Motion::moving) {}

std::vector<Contestant> pair_contestants(Copies& copies, const Poses& poses, const PairQuestion& question) {
  const auto find = question.first ? Options::Find::first : Options::Find::all;
  Options quick = fast(), plain = paper_way();
  quick.find = plain.find = find;
  std::vector<Contestant> contestants{impinge_contestant("impinge", copies, poses, quick),
                                      impinge_contestant("impinge paper", copies, poses, plain),
                                      tree_contestant("FCL", copies.fcl, poses, question.first),
                                      tree_contestant("FCL native", copies.fcl_native, poses, question.first)};
  if (!question.first) contestants.push_back(embree_with_refit(copies, poses));
  if (!question.first && question.query_alone) contestants.push_back(embree_query_alone(copies, poses));
  if (question.query_alone) contestants.push_back(cgal_query_alone(copies, poses, question.first));
#ifdef IMPINGE_BENCH_RAPID
  contestants.push_back(new_tree_contestant<RapidMesh>("RAPID", copies, poses, question.first));
#endif
  return contestants;
}

std::vector<Contestant> paper_contestants(Copies& copies, const Poses& poses) {
  static const bool allows_software = std::getenv("IMPINGE_BENCH_SOFTWARE") != nullptr;
  static const TargetDevice device = choose_device("", allows_software);
  std::vector<Contestant> contestants = pair_contestants(copies, poses);
  contestants.push_back(new_tree_contestant<FclSameFlagsMesh>("FCL same flags", copies, poses, false));
  if (device.option.empty()) return contestants;
  for (const char* const backend : {"raster", "gpu", "hybrid"}) {
    Options options{.threads = 1, .backend = backend, .device = device.option};
    // By itself it gives nothing to a software driver.
    if (allows_software) options.device_share = 0.5;
    const std::string name = std::string("impinge ") + backend + (allows_software ? " (tried out)" : "");
    contestants.push_back(impinge_contestant(name, copies, poses, options));
    contestants.back().waits = true;
  }
  return contestants;
}

std::vector<std::vector<TrianglePair>> yes_or_no(const std::vector<std::vector<TrianglePair>>& answers) {
  std::vector<std::vector<TrianglePair>> result;
  for (const auto& answer : answers) result.push_back(some_pair_if(!answer.empty()));
  return result;
}

}  // namespace impinge::bench
