// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/assembly_contest.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "bench/assemblies.hpp"
#include "bench/ours.hpp"
#include "bench/peers/cgal.hpp"
#include "bench/peers/common.hpp"
#include "bench/peers/embree.hpp"
#include "bench/peers/fcl.hpp"

namespace impinge::bench {
namespace {

using ObjectPair = std::array<std::uint32_t, 2>;

bool spheres_meet(const io::Object& a, const io::Object& b) {
  const Point p = world_vertex(a.pose, a.mesh.sphere_center()), q = world_vertex(b.pose, b.mesh.sphere_center());
  constexpr double kRounding = 1 + 1e-6;  // poses are rotations to within that
  return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) <= kRounding * (a.mesh.sphere_radius() + b.mesh.sphere_radius());
}

std::vector<ObjectPair> candidate_pairs(const std::vector<io::Object>& objects) {
  std::vector<ObjectPair> candidates;
  for (std::uint32_t a = 0; a < objects.size(); ++a)
    for (std::uint32_t b = a + 1; b < objects.size(); ++b)
      if (spheres_meet(objects[a], objects[b])) candidates.push_back({a, b});
  return candidates;
}

std::vector<TrianglePair> transposed(std::vector<TrianglePair> pairs) {
  for (TrianglePair& pair : pairs) std::swap(pair.a, pair.b);
  return sorted(std::move(pairs));
}

/// A part in the terms of each peer. Parts that share a mesh share FCL's tree, which has no place of its own.
struct Part {
  const io::Object& object;
  std::unique_ptr<scenes::MeshData> data;
  std::shared_ptr<FclDebianMesh> fcl;
  CgalBody cgal;
  EmbreeBody embree;
};

class Parts {
 public:
  explicit Parts(const io::Model& model) : candidates_(candidate_pairs(model.objects)) {
    std::map<const MeshState*, std::shared_ptr<FclDebianMesh>> known;
    for (const io::Object& object : model.objects) {
      auto data = std::make_unique<scenes::MeshData>(numbers_of(object.mesh));
      auto& fcl = known[&object.mesh.state()];
      if (!fcl) fcl = std::make_shared<FclDebianMesh>(*data);
      CgalBody cgal(*data, object.pose);
      cgal.build_tree();
      EmbreeBody embree(*data, object.pose, EmbreeBody::Motion::fixed);
      parts_.push_back({object, std::move(data), fcl, std::move(cgal), std::move(embree)});
    }
  }

  [[nodiscard]] const std::vector<ObjectPair>& candidates() const { return candidates_; }

  /// Question i is about candidate i.
  std::vector<Contestant> contestants() {
    const auto a = [this](std::size_t i) -> Part& { return parts_[candidates_[last_ = i][0]]; };
    const auto b = [this](std::size_t i) -> Part& { return parts_[candidates_[i][1]]; };
    // CGAL asks one part's tree about each triangle of the other: the tree is the larger one's.
    const auto swaps = [a, b](std::size_t i) {
      return a(i).object.mesh.triangle_count() < b(i).object.mesh.triangle_count();
    };
    return {{"FCL", [a, b](std::size_t i) { a(i).fcl->collide(a(i).object.pose, *b(i).fcl, b(i).object.pose); },
             [this, a] { return a(last_).fcl->pairs(); }},
            {"Embree query alone", [a, b](std::size_t i) { a(i).embree.collide(b(i).embree); },
             [this, a] { return a(last_).embree.pairs(); }},
            {"CGAL query alone",
             [a, b, swaps](std::size_t i) { swaps(i) ? b(i).cgal.collide(a(i).cgal) : a(i).cgal.collide(b(i).cgal); },
             [this, a, b, swaps] { return swaps(last_) ? transposed(b(last_).cgal.pairs()) : a(last_).cgal.pairs(); }}};
  }

 private:
  std::vector<ObjectPair> candidates_;
  std::vector<Part> parts_;
  std::size_t last_ = 0;
};

/// The row of a pair of objects, which may be empty.
std::vector<TrianglePair> row_of(const Contacts& contacts, const ObjectPair& pair) {
  const auto row = std::lower_bound(contacts.objects.begin(), contacts.objects.end(), pair);
  if (row == contacts.objects.end() || *row != pair) return {};
  const auto r = static_cast<std::size_t>(row - contacts.objects.begin());
  const auto triangles =
      std::span(contacts.triangles).subspan(contacts.offsets[r], contacts.offsets[r + 1] - contacts.offsets[r]);
  return {triangles.begin(), triangles.end()};
}

}  // namespace

void AssemblyContest::add(const std::string& name, const io::Model& model, const Effort& effort) {
  const Scene scene = fresh_scene(model);
  const Contacts exact = exact_answer(scene);
  Parts parts(model);
  std::vector<std::vector<TrianglePair>> rows;
  for (const ObjectPair& pair : parts.candidates()) rows.push_back(row_of(exact, pair));

  Workspace workspace;
  Contacts answer;
  const auto impinge_with = [&](const Options& options) {
    return [&, options](std::size_t) {
      workspace.recycle(std::move(answer));
      answer = must(scene.collide(options, &workspace));
    };
  };
  std::vector<Contestant> whole{{"impinge", impinge_with(fast())}, {"impinge paper", impinge_with(paper_way())}};
  std::vector<Disagreement> wrong(whole.size());
  for (const Contestant& peer : parts.contestants()) {
    wrong.push_back(compare(peer, rows));
    whole.push_back({peer.name, [peer, n = rows.size()](std::size_t) {
                       for (std::size_t i = 0; i < n; ++i) peer.ask(i);
                     }});
  }
  const std::vector<Times> times = contest(whole, 1, effort);
  for (std::size_t c = 0; c < whole.size(); ++c) {
    const Spread ratio = spread(times[c].ratio);
    table_.add({name, whole[c].name, count(exact.triangles.size()), count(exact.objects.size()),
                milliseconds(median(times[c].seconds)), digits(ratio.median), digits(ratio.low), digits(ratio.high),
                count(wrong[c].missed), count(wrong[c].added), count(wrong[c].wrong_answers)});
  }
}

}  // namespace impinge::bench
