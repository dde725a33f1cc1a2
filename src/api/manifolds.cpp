// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/manifolds.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "clash/manifold/manifold.hpp"
#include "core/guarded.hpp"
#include "pipeline/scene_state.hpp"

namespace impinge {

/// What the state is made of.
namespace manifolds {

/// What manifolds need to know of a mesh, in its own frame.
struct KnownMesh {
  explicit KnownMesh(const MeshState& state)
      : mesh(state.weak_from_this()), topology(solid::examine(solid::make_body(state.placed({})))) {
    const LocalFrame frame = local_frame(state.data.box, state.data.box);
    double volume = 0;
    for (const auto& [i, j, k] : state.data.triangles) {
      const auto local = [&](std::uint32_t v) { return frame.to_local(state.data.vertices[v]); };
      volume += determinant({local(i), local(j), local(k)});
    }
    is_inward = topology.closed && volume < 0;
  }
  std::weak_ptr<const MeshState> mesh;
  solid::Topology topology;
  bool is_inward;
};

/// A manifold with what tells its next one from others: in the frame of its object a, which may move.
struct Kept {
  Manifold manifold;
  std::array<std::uint32_t, 2> generations;
  Vec3 middle;
  std::array<Vec3, 4> points;
};

/// A pair of things that may go on as one another, by the squared distance between them.
struct Match {
  double distance;
  std::uint32_t before, now;
  friend auto operator<=>(const Match&, const Match&) = default;
};

}  // namespace manifolds

namespace {

using namespace manifolds;

Vec3 in_frame_of(const Pose& pose, const Vec3& p) {
  return transpose(to_mat3(pose.R)) * (p - Vec3{pose.t[0], pose.t[1], pose.t[2]});
}

Kept keep(const Manifold& manifold, const Pose& pose, const std::array<std::uint32_t, 2>& generations) {
  Kept kept{manifold, generations, in_frame_of(pose, manifold.middle), {}};
  for (std::size_t i = 0; i < manifold.size; ++i) kept.points[i] = in_frame_of(pose, manifold.points[i].a);
  return kept;
}

/// Calls join(before, now) for the nearest of the matches, then the nearest of those that are left, and so on.
template <class Join>
void match(std::vector<Match>& matches, std::vector<std::uint8_t>& taken, std::size_t before, std::size_t now,
           const Join& join) {
  std::sort(matches.begin(), matches.end());
  taken.assign(before + now, 0);
  for (const Match& m : matches)
    if (taken[m.before] == 0 && taken[before + m.now] == 0) {
      taken[m.before] = taken[before + m.now] = 1;
      join(m.before, m.now);
    }
}

double squared(const Vec3& v) { return dot(v, v); }

}  // namespace

struct ContactManifolds::State {
  const KnownMesh& known(const MeshState& mesh);
  Result<void> check(const Scene::State& scene, const Contacts& contacts) const;
  void add_row(const Scene::State& scene, const Contacts& contacts, std::size_t row);
  void go_on(std::span<const Kept> old, std::size_t first);
  void order_points(const Kept& old, Kept& now);

  std::unordered_map<const MeshState*, KnownMesh> meshes;
  clash::ManifoldMaker maker;
  std::vector<Manifold> of_row, manifolds;
  std::vector<Kept> before, now;  ///< by objects
  std::uint64_t next_id = 1;
  std::vector<Match> matches;
  std::vector<std::uint8_t> taken;
};

const KnownMesh& ContactManifolds::State::known(const MeshState& mesh) {
  const auto found = meshes.find(&mesh);
  if (found != meshes.end() && !found->second.mesh.expired()) return found->second;
  std::erase_if(meshes, [](const auto& entry) { return entry.second.mesh.expired(); });
  return meshes.try_emplace(&mesh, mesh).first->second;
}

Result<void> ContactManifolds::State::check(const Scene::State& scene, const Contacts& contacts) const {
  if (contacts.truncated || contacts.partial)
    return Error{Code::bad_option,
                 contacts.truncated
                     ? "the contacts were cut off at a limit; ask for all of them"
                     : "the contacts are some of all, by Find::first or Options::kinds; ask for all of them"};
  for (std::size_t row = 0; row < contacts.objects.size(); ++row) {
    for (const int side : {0, 1}) {
      const std::uint32_t object = contacts.objects[row][static_cast<std::size_t>(side)];
      if (object >= scene.slots.size() || !scene.slots[object].mesh)
        return Error{Code::unknown_id, "contacts.objects[" + std::to_string(row) + "] names object " +
                                           std::to_string(object) +
                                           ", which is not in this scene; give contacts that it has just found"};
      const std::size_t size = scene.meshes[object]->data.triangles.size();
      for (std::uint64_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i)
        if ((side == 0 ? contacts.triangles[i].a : contacts.triangles[i].b) >= size)
          return Error{Code::unknown_id, "contacts.triangles[" + std::to_string(i) + "] names a triangle that object " +
                                             std::to_string(object) +
                                             " does not have; give contacts that this scene has just found"};
    }
  }
  return {};
}

void ContactManifolds::State::add_row(const Scene::State& scene, const Contacts& contacts, std::size_t row) {
  const std::array<std::uint32_t, 2>& objects = contacts.objects[row];
  const std::size_t first = contacts.offsets[row], count = contacts.offsets[row + 1] - first;
  if (count == 0 || objects[0] == objects[1]) return;
  const std::array placed{&scene.objects[objects[0]], &scene.objects[objects[1]]};
  const LocalFrame frame = local_frame(placed[0]->box, placed[1]->box);
  const auto surface = [&](std::size_t side) {
    const KnownMesh& mesh = known(*scene.meshes[objects[side]]);
    return clash::PlacedSurface{placed[side]->mesh, &mesh.topology, mesh.is_inward, placed[side]->pose, frame};
  };
  of_row.clear();
  maker.append({{surface(0), surface(1)}, {&contacts.triangles[first], count}}, of_row);
  const std::array generations{scene.slots[objects[0]].generation, scene.slots[objects[1]].generation};
  const std::size_t begin = now.size();
  for (Manifold& manifold : of_row) {
    manifold.objects = objects;
    now.push_back(keep(manifold, placed[0]->pose, generations));
  }
  const auto by_objects = [](const Kept& kept) { return kept.manifold.objects; };
  const auto old = std::ranges::lower_bound(before, objects, {}, by_objects);
  go_on({old, std::ranges::upper_bound(old, before.end(), objects, {}, by_objects)}, begin);
}

/// Gives the regions from `first` on the ids of the last call.
void ContactManifolds::State::go_on(std::span<const Kept> old, std::size_t first) {
  const std::span fresh = std::span(now).subspan(first);
  matches.clear();
  for (std::uint32_t i = 0; i < old.size(); ++i)
    for (std::uint32_t k = 0; k < fresh.size(); ++k)
      if (old[i].generations == fresh[k].generations)
        matches.push_back({squared(old[i].middle - fresh[k].middle), i, k});
  match(matches, taken, old.size(), fresh.size(),
        [&](std::uint32_t i, std::uint32_t k) { fresh[k].manifold.id = old[i].manifold.id; });
  for (Kept& kept : fresh) {
    const auto same = std::ranges::find(old, kept.manifold.id, [](const Kept& k) { return k.manifold.id; });
    if (same == old.end())
      kept.manifold.id = next_id++;
    else
      order_points(*same, kept);
  }
}

/// Points go on in the places that the nearest ones of the last call had, as far as there are so many now.
void ContactManifolds::State::order_points(const Kept& old, Kept& kept) {
  const std::uint32_t size = kept.manifold.size, places = std::min(size, old.manifold.size);
  matches.clear();
  for (std::uint32_t i = 0; i < places; ++i)
    for (std::uint32_t k = 0; k < size; ++k) matches.push_back({squared(old.points[i] - kept.points[k]), i, k});
  std::array<std::uint32_t, 4> at{};
  std::array<bool, 4> is_placed{};
  match(matches, taken, places, size, [&](std::uint32_t i, std::uint32_t k) { at[k] = i, is_placed[k] = true; });
  std::uint32_t next = places;
  const Kept chosen = kept;
  for (std::uint32_t k = 0; k < size; ++k) {
    const std::uint32_t place = is_placed[k] ? at[k] : next++;
    kept.manifold.points[place] = chosen.manifold.points[k], kept.points[place] = chosen.points[k];
  }
}

ContactManifolds::ContactManifolds() : state_(std::make_unique<State>()) {}
ContactManifolds::~ContactManifolds() = default;
ContactManifolds::ContactManifolds(ContactManifolds&&) noexcept = default;
ContactManifolds& ContactManifolds::operator=(ContactManifolds&&) noexcept = default;

Result<std::span<const Manifold>> ContactManifolds::update(const Scene& scene, const Contacts& contacts) {
  return guarded([&]() -> Result<std::span<const Manifold>> {
    State& s = *state_;
    if (auto valid = s.check(*scene.state_, contacts); !valid) return valid.error();
    std::swap(s.before, s.now);
    s.now.clear(), s.manifolds.clear();
    for (std::size_t row = 0; row < contacts.objects.size(); ++row) s.add_row(*scene.state_, contacts, row);
    for (const Kept& kept : s.now) s.manifolds.push_back(kept.manifold);
    return std::span<const Manifold>(s.manifolds);
  });
}

}  // namespace impinge
