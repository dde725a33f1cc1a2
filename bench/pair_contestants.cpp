// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/pair_contestants.hpp"

#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/common.hpp"

namespace impinge::bench {
namespace {

using Poses = std::vector<scenes::PosePair>;

std::vector<TrianglePair> some_pair_if(bool touches) {
  if (touches) return {{0, 0}};
  return {};
}

/// With a workspace, as a caller who asks again and again would.
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
          [state, first] { return first ? some_pair_if(!state->answer.triangles.empty()) : state->answer.triangles; }};
}

template <class Fcl>
Contestant fcl_contestant(const char* name, Fcl& fcl, const Poses& poses, bool first) {
  const std::size_t limit = first ? 1 : std::numeric_limits<std::size_t>::max();
  return {name, [&, limit](std::size_t i) { fcl.collide(poses[i].a, fcl, poses[i].b, limit); },
          [&, first] { return first ? some_pair_if(!fcl.pairs().empty()) : fcl.pairs(); }};
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
                                      fcl_contestant("FCL", copies.fcl, poses, question.first),
                                      fcl_contestant("FCL native", copies.fcl_native, poses, question.first)};
  if (!question.first) contestants.push_back(embree_with_refit(copies, poses));
  if (!question.first && question.query_alone) contestants.push_back(embree_query_alone(copies, poses));
  if (question.query_alone) contestants.push_back(cgal_query_alone(copies, poses, question.first));
  return contestants;
}

std::vector<std::vector<TrianglePair>> yes_or_no(const std::vector<std::vector<TrianglePair>>& answers) {
  std::vector<std::vector<TrianglePair>> result;
  for (const auto& answer : answers) result.push_back(some_pair_if(!answer.empty()));
  return result;
}

}  // namespace impinge::bench
