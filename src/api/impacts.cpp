// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/impacts.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/guarded.hpp"
#include "impinge/collide.hpp"
#include "motion/box_path.hpp"
#include "pipeline/impacts_of_pairs.hpp"
#include "pipeline/mesh_state.hpp"

namespace impinge {
namespace {

constexpr broad::ObjectPair kItself{0, 0}, kPair{0, 1};

/// `name`: of the mesh, for errors.
Result<void> validate(const Moving& mesh, const std::string& name) {
  if (mesh.from.vertex_count() != mesh.to.vertex_count())
    return Error{Code::bad_mesh, name + " has " + std::to_string(mesh.from.vertex_count()) +
                                     " vertices at the start and " + std::to_string(mesh.to.vertex_count()) +
                                     " at the end; give two states of one mesh"};
  const auto start = mesh.from.triangles(), end = mesh.to.triangles();
  if (start.size() != end.size())
    return Error{Code::bad_mesh, name + " has " + std::to_string(start.size()) + " triangles at the start and " +
                                     std::to_string(end.size()) + " at the end; give two states of one mesh"};
  if (const auto [one, two] = std::ranges::mismatch(start, end); one != start.end())
    return Error{Code::bad_mesh, name + "'s triangle " + std::to_string(one - start.begin()) +
                                     " has other vertices at the end than at the start; give two states of one mesh"};
  return {};
}

MovingObject object_of(const Moving& mesh) {
  const MeshState& state = mesh.from.state();
  if (state.data.triangles.empty()) return {};
  return {{mesh.from.vertices(), mesh.to.vertices()}, &state.features->of(state.data.triangles), state.features.get()};
}

Impacts without_rows(SceneImpacts found) { return {std::move(found.impacts), found.earliest, found.truncated}; }

// The shares of the time of the first impact that a step tries, the last of which hardly ever moves anything.
constexpr std::array kShares{1 - 0x1p-11, 1 - 0x1p-8, 1 - 0x1p-5, 0.75,    0.25,
                             0x1p-4,      0x1p-8,     0x1p-16,    0x1p-32, 0x1p-64};

/// Meshes that go together, and those of their pairs of which one moves.
class Together {
 public:
  Together(std::span<const Moving> meshes, const MotionOptions& options) : meshes_(meshes), options_(options) {
    options_.earliest = true;
    for (const Moving& mesh : meshes) {
      objects_.push_back(object_of(mesh));
      moves_.push_back(!std::ranges::equal(mesh.from.vertices(), mesh.to.vertices()));
    }
  }

  Result<Step> step() {
    if (auto apart = check_start(); !apart) return apart.error();
    const double until = options_.end;
    const SceneImpacts first = find(until);
    if (first.earliest && first.earliest->hi == 0)
      return options_.separation > 0
                 ? too_near(first.objects[0], first.impacts[0])
                 : in_contact(first.objects[0],
                              "vertices that are at one place there, and go different ways, count as two");
    if (!first.earliest && certify(until)) return end(until);
    const double latest = first.earliest ? first.earliest->lo : until;
    for (const double share : kShares)
      if (const double time = share * latest; certify(time)) return end(time);
    place(0);
    return end(0);
  }

 private:
  /// The first impact until `until`, of the pairs whose boxes do not say that there is none.
  SceneImpacts find(double until) {
    std::vector<motion::BoxPath> bounds;
    for (const MovingObject& object : objects_)
      bounds.push_back(
          object.features != nullptr
              ? motion::grown(motion::path_of(object.vertices, object.features->corners), options_.separation)
              : motion::BoxPath{});
    std::vector<broad::ObjectPair> pairs;
    for (std::uint32_t i = 0; i < objects_.size(); ++i)
      for (std::uint32_t j = i; j < objects_.size(); ++j)
        if ((moves_[i] || moves_[j]) && (i == j || !motion::stay_apart(bounds[i], bounds[j], until)))
          pairs.push_back({i, j});
    options_.end = until;
    return impacts_of_pairs(objects_, pairs, options_);
  }

  /// Moves everything to a time. Whether nothing meets on the straight way there.
  bool certify(double time) {
    place(time);
    return time == 1 || !find(1).earliest;
  }

  void place(double time) {
    ends_.resize(meshes_.size());
    const auto between = [time](double x, double y) { return x == y ? x : (1 - time) * x + time * y; };
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const auto from = meshes_[i].from.vertices(), to = meshes_[i].to.vertices();
      ends_[i].assign(from.begin(), from.end());
      for (std::size_t v = 0; v < from.size(); ++v)
        ends_[i][v] = {between(from[v].x, to[v].x), between(from[v].y, to[v].y), between(from[v].z, to[v].z)};
      objects_[i].vertices.to = ends_[i];
    }
  }

  Result<Step> end(double time) const {
    Step step{time, {}};
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const auto& [from, to] = meshes_[i];
      if (!moves_[i] || time == 1) {
        step.ends.push_back(moves_[i] ? to : from);
        continue;
      }
      std::vector<double> xyz;
      xyz.reserve(3 * ends_[i].size());
      for (const Vec3& v : ends_[i]) xyz.insert(xyz.end(), {v.x, v.y, v.z});
      auto mesh = from.deformed(xyz);
      if (!mesh) return mesh.error();
      step.ends.push_back(*std::move(mesh));
    }
    return step;
  }

  static Error in_contact(const std::array<std::uint32_t, 2>& pair, const std::string& where) {
    const auto& [i, j] = pair;
    const std::string what = i == j ? "mesh " + std::to_string(i) + " touches itself"
                                    : "meshes " + std::to_string(i) + " and " + std::to_string(j) + " touch";
    return {Code::in_contact,
            what + " at the start (counted from 0): " + where + "; a step starts from where all is apart"};
  }

  static Error too_near(const std::array<std::uint32_t, 2>& pair, const Impact& impact) {
    const bool edges = impact.feature == Feature::edge_edge;
    const auto feature = [&](Feature face, std::uint32_t index, std::uint32_t mesh) {
      return (edges                    ? "edge "
              : impact.feature == face ? "triangle "
                                       : "vertex ") +
             std::to_string(index) + " of mesh " + std::to_string(mesh);
    };
    return {Code::in_contact, feature(Feature::face_vertex, impact.a, pair[0]) + " and " +
                                  feature(Feature::vertex_face, impact.b, pair[1]) +
                                  " (counted from 0) are within the separation at the start; a step starts from where "
                                  "all is farther apart: choose a smaller separation, also than a mesh's own triangles "
                                  "without a common vertex are apart"};
  }

  /// Impacts are of features, so that what goes through something at the start need not have one there.
  [[nodiscard]] Result<void> check_start() const {
    const Options options{.find = Options::Find::first,
                          .threads = options_.threads,
                          .adjacency = options_.adjacency,
                          .stop = options_.stop};
    for (std::uint32_t i = 0; i < meshes_.size(); ++i)
      for (std::uint32_t j = i; j < meshes_.size(); ++j) {
        if (!moves_[i] && !moves_[j]) continue;
        const Mesh &a = meshes_[i].from, &b = meshes_[j].from;
        const auto contacts = i == j ? self_collide(a, {}, options) : collide(a, {}, b, {}, options);
        if (!contacts) return contacts.error();
        if (contacts->triangles.empty()) continue;
        const auto& [one, two] = contacts->triangles[0];
        return in_contact({i, j}, "triangle " + std::to_string(one) + " and triangle " + std::to_string(two));
      }
    return {};
  }

  std::span<const Moving> meshes_;
  MotionOptions options_;
  std::vector<MovingObject> objects_;
  std::vector<bool> moves_;
  std::vector<std::vector<Vec3>> ends_;
};

}  // namespace

Result<Impacts> find_impacts(const Moving& a, const Moving& b, const MotionOptions& options) {
  return guarded([&]() -> Result<Impacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(a, "the first mesh"); !valid) return valid.error();
    if (auto valid = validate(b, "the second mesh"); !valid) return valid.error();
    return without_rows(impacts_of_pairs(std::array{object_of(a), object_of(b)}, std::array{kPair}, options));
  });
}

Result<Impacts> find_impacts(const Moving& mesh, const MotionOptions& options) {
  return guarded([&]() -> Result<Impacts> {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(mesh, "the mesh"); !valid) return valid.error();
    return without_rows(impacts_of_pairs(std::array{object_of(mesh)}, std::array{kItself}, options));
  });
}

Result<Step> collision_free_step(std::span<const Moving> meshes, const MotionOptions& options) {
  return guarded([&]() -> Result<Step> {
    if (auto valid = validate(options); !valid) return valid.error();
    for (std::size_t i = 0; i < meshes.size(); ++i)
      if (auto valid = validate(meshes[i], "mesh " + std::to_string(i)); !valid) return valid.error();
    return Together(meshes, options).step();
  });
}

}  // namespace impinge
