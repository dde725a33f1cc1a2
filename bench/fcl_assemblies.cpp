// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "bench/assemblies.hpp"
#include "bench/fcl_errors.hpp"
#include "bench/fcl_peer.hpp"

namespace impinge::bench {
namespace {

using ObjectPair = std::array<std::uint32_t, 2>;

/// The model in FCL's terms: a tree for each mesh, and the pairs of objects whose bounding spheres meet.
class FclAssembly {
 public:
  explicit FclAssembly(const io::Model& model) : objects_(model.objects) {
    for (const io::Object& object : objects_) {
      const MeshState* known = &object.mesh.state();
      if (!meshes_.contains(known)) meshes_.emplace(known, FclMesh(numbers_of(object.mesh)));
      trees_.push_back(&meshes_.at(known));
    }
    for (std::uint32_t a = 0; a < objects_.size(); ++a)
      for (std::uint32_t b = a + 1; b < objects_.size(); ++b)
        if (spheres_meet(objects_[a], objects_[b])) candidates_.push_back({a, b});
  }

  [[nodiscard]] const std::vector<ObjectPair>& candidates() const { return candidates_; }

  FclMesh& collide(const ObjectPair& pair) {
    trees_[pair[0]]->collide(objects_[pair[0]].pose, *trees_[pair[1]], objects_[pair[1]].pose);
    return *trees_[pair[0]];
  }

 private:
  static bool spheres_meet(const io::Object& a, const io::Object& b) {
    const Point p = world_vertex(a.pose, a.mesh.sphere_center()), q = world_vertex(b.pose, b.mesh.sphere_center());
    constexpr double kRounding = 1 + 1e-6;  // poses are rotations to within that
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) <= kRounding * (a.mesh.sphere_radius() + b.mesh.sphere_radius());
  }

  const std::vector<io::Object>& objects_;
  std::map<const MeshState*, FclMesh> meshes_;
  std::vector<FclMesh*> trees_;  // an object's
  std::vector<ObjectPair> candidates_;
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

Table fcl_on_assemblies(int repeats) {
  Table table({"assembly", "FCL ms", "impinge ms", "impinge / FCL", "lowest", "highest", "touching triangle pairs",
               "FCL misses", "FCL adds", "touching object pairs", "FCL's yes or no wrong"});
  for (const Assembly& assembly : assemblies()) {
    const io::Model model = read_model(assembly);
    const Scene scene = fresh_scene(model);
    FclAssembly fcl(model);
    const Contacts exact = must(scene.collide({.threads = 1}));
    Disagreement sum;
    std::uint64_t wrong_answers = 0;
    for (const ObjectPair& pair : fcl.candidates()) {
      const std::vector<TrianglePair> right = row_of(exact, pair), found = fcl.collide(pair).pairs();
      const Disagreement wrong = compare(right, found);
      sum.missed += wrong.missed;
      sum.added += wrong.added;
      wrong_answers += right.empty() != found.empty();
    }
    std::vector<double> ours, theirs, ratios;
    for (int i = 0; i < repeats; ++i) {
      theirs.push_back(seconds_of([&] {
        for (const ObjectPair& pair : fcl.candidates()) fcl.collide(pair);
      }));
      ours.push_back(seconds_of([&] { (void)must(scene.collide({.threads = 1})); }));
      ratios.push_back(ours.back() / theirs.back());
    }
    const Spread ratio = spread(ratios);
    table.add({assembly.name, milliseconds(median(theirs)), milliseconds(median(ours)), digits(ratio.median),
               digits(ratio.low), digits(ratio.high), count(exact.triangles.size()), count(sum.missed),
               count(sum.added), count(exact.objects.size()), count(wrong_answers)});
  }
  return table;
}

}  // namespace impinge::bench
