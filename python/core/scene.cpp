// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "python/core/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "impinge/manifolds.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"

namespace impinge::python {
namespace {

/// An object's id as one number: its generation above its index.
std::uint64_t to_number(ObjectId id) { return std::uint64_t{id.generation} << 32 | id.index; }
ObjectId to_id(std::uint64_t number) {
  return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
}

std::vector<ObjectId> to_ids(const std::vector<std::uint64_t>& numbers) {
  std::vector<ObjectId> ids(numbers.size());
  std::transform(numbers.begin(), numbers.end(), ids.begin(), to_id);
  return ids;
}

/// Holds a scene's mutex inside a `with` statement. The object keeps the scene alive.
template <bool kAlone>
struct Hold {
  py::object scene;

  [[nodiscard]] std::shared_mutex& mutex() const { return scene.cast<SharedScene&>().mutex; }
  void enter() {
    std::shared_mutex& lock = mutex();
    if (kAlone ? lock.try_lock() : lock.try_lock_shared()) return;
    const Unlocked released;
    kAlone ? lock.lock() : lock.lock_shared();
  }
  void exit(const py::args&) { kAlone ? mutex().unlock() : mutex().unlock_shared(); }
};

template <bool kAlone>
void bind_hold(py::module_& module, const char* name) {
  py::class_<Hold<kAlone>>(module, name)
      .def(py::init([](py::object scene) { return Hold<kAlone>{std::move(scene)}; }))
      .def("__enter__", &Hold<kAlone>::enter)
      .def("__exit__", &Hold<kAlone>::exit);
}

/// What `change(scene)` returns, with the interpreter's lock released.
template <class Change>
auto unlocked(SharedScene& shared, Change change) {
  return unwrap([&] {
    const Unlocked released;
    return change(shared.scene);
  }());
}

py::tuple to_python(const ObjectDistance& found) {
  return py::make_tuple(found.objects[0], found.objects[1], nearest_tuple(found.nearest));
}

py::tuple collide_all(SharedScene& shared, const QueryOptions& options, const Stop* stop) {
  return contacts_tuple(unwrap(
      run(stop, shared.triangles, [&](std::stop_token token) { return shared.scene.collide(options.with(token)); })));
}

py::tuple collide_one(SharedScene& shared, std::uint64_t id, const QueryOptions& options, const Stop* stop) {
  return contacts_tuple(unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return shared.scene.collide_with(to_id(id), options.with(token));
  })));
}

/// Of a query of a mesh and the scene. The first contact with each object near it is a matter of microseconds, so such
/// an object counts as one triangle.
std::size_t size_of_visit(const SharedScene& shared, const Mesh& mesh, bool first) {
  return mesh.triangle_count() + (first ? shared.scene.size() : shared.triangles);
}

py::tuple collide_mesh(SharedScene& shared, const Mesh& mesh, py::handle pose, const QueryOptions& options,
                       const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  return contacts_tuple(unwrap(run(stop, size_of_visit(shared, mesh, options.first), [&](std::stop_token token) {
    return shared.scene.collide_with(mesh, at, options.with(token));
  })));
}

bool touches_mesh(SharedScene& shared, const Mesh& mesh, py::handle pose, int threads, const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  const std::size_t size = size_of_visit(shared, mesh, true);
  if (threads == 0 && size < kMayTakeLong) threads = 1;
  return unwrap(run(stop, size, [&](std::stop_token token) {
    return shared.scene.touches_with(mesh, at, {.threads = threads, .stop = token});
  }));
}

bool touches_any(SharedScene& shared, int threads, const Stop* stop) {
  return unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return shared.scene.touches_any({.threads = threads, .stop = token});
  }));
}

/// Poses of as many configurations as there are, for each of the ids.
struct Path {
  std::vector<ObjectId> ids;
  std::vector<Pose> poses;

  Path(const std::vector<std::uint64_t>& numbers, py::handle matrices)
      : ids(to_ids(numbers)), poses(poses_of(View(matrices), "poses")) {}
  [[nodiscard]] std::size_t size(const SharedScene& shared) const {
    return shared.triangles * std::max<std::size_t>(1, poses.size() / std::max<std::size_t>(1, ids.size()));
  }
};

py::tuple collide_configurations(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                                 bool witnesses, int threads, const Stop* stop) {
  const Path path(ids, poses);
  Configurations found = unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.collide_configurations(path.ids, path.poses,
                                               {.witnesses = witnesses, .threads = threads, .stop = token});
  }));
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<Touch> touches;
  for (const auto& touch : found.witnesses) touches.push_back(touch.value_or(Touch{{kNone, kNone}, {kNone, kNone}}));
  const auto count = static_cast<py::ssize_t>(found.touches.size()), rows = static_cast<py::ssize_t>(touches.size());
  return py::make_tuple(array_of(std::move(found.touches), "?", 1, {count}),
                        array_of(std::move(touches), "i", 4, {rows, 4}));
}

std::optional<std::size_t> first_touching(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                                          int threads, const Stop* stop) {
  const Path path(ids, poses);
  return unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.first_touching(path.ids, path.poses, {.threads = threads, .stop = token});
  }));
}

py::object distance_of_all(SharedScene& shared, std::optional<std::uint64_t> id, const DistanceOptions& options,
                           const Stop* stop) {
  const auto found = unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return id ? shared.scene.distance_with(to_id(*id), options.with(token))
              : shared.scene.distance(options.with(token));
  }));
  return found ? py::object(to_python(*found)) : py::none();
}

py::list closest_pairs(SharedScene& shared, std::size_t count, const DistanceOptions& options, const Stop* stop) {
  const auto found = unwrap(run(
      stop, shared.triangles, [&](std::stop_token token) { return shared.scene.closest(count, options.with(token)); }));
  py::list all;
  for (const ObjectDistance& pair : found) all.append(to_python(pair));
  return all;
}

Array distance_configurations(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                              const DistanceOptions& options, const Stop* stop) {
  const Path path(ids, poses);
  const auto found = unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.distance_configurations(path.ids, path.poses, options.with(token));
  }));
  std::vector<double> distances(found.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k]) distances[k] = found[k]->nearest.distance;
  return array_of(std::move(distances), "d", 8, {static_cast<py::ssize_t>(found.size())});
}

Array pose_of_object(SharedScene& shared, std::uint64_t id) { return matrix_of(unwrap(shared.scene.pose(to_id(id)))); }

/// What one frame after the other uses.
struct SharedManifolds {
  ContactManifolds manifolds;
  std::mutex mutex;
};

/// Rows that fit together; whether the scene has what they name, it says itself.
Contacts contacts_of(py::handle objects, py::handle offsets, py::handle pairs, bool truncated) {
  Contacts contacts;
  contacts.objects = copy_of<std::array<std::uint32_t, 2>>(objects);
  contacts.offsets = copy_of<std::uint64_t>(offsets);
  contacts.triangles = copy_of<TrianglePair>(pairs);
  contacts.truncated = truncated;
  const auto& ends = contacts.offsets;
  if (ends.size() != contacts.objects.size() + 1 || ends.front() != 0 || ends.back() != contacts.triangles.size() ||
      !std::is_sorted(ends.begin(), ends.end()))
    raise({Code::bad_option, "the arrays of the contacts do not fit together; give contacts as a scene found them"});
  return contacts;
}

py::tuple update_manifolds(SharedManifolds& shared, SharedScene& scene, py::handle objects, py::handle offsets,
                           py::handle pairs, bool truncated) {
  const Contacts contacts = contacts_of(objects, offsets, pairs, truncated);
  const auto found =
      unwrap(run(nullptr, contacts.triangles.size(), [&](std::stop_token) -> Result<std::vector<Manifold>> {
        const std::lock_guard lock(shared.mutex);
        const auto all = shared.manifolds.update(scene.scene, contacts);
        if (!all) return all.error();
        return std::vector<Manifold>(all->begin(), all->end());
      }));
  std::vector<std::array<std::uint32_t, 2>> of;
  std::vector<std::uint64_t> ids;
  std::vector<Point> middles, normals;
  std::vector<double> depths;
  std::vector<std::uint32_t> sizes;
  std::vector<std::array<Point, 2>> points;
  std::vector<double> point_depths;
  for (const Manifold& manifold : found) {
    of.push_back(manifold.objects);
    ids.push_back(manifold.id);
    middles.push_back(manifold.middle);
    normals.push_back(manifold.normal);
    depths.push_back(manifold.depth);
    sizes.push_back(manifold.size);
    for (std::uint32_t i = 0; i < manifold.points.size(); ++i) {
      const ManifoldPoint point = i < manifold.size ? manifold.points[i] : ManifoldPoint{};
      points.push_back({point.a, point.b});
      point_depths.push_back(point.depth);
    }
  }
  const auto count = static_cast<py::ssize_t>(found.size());
  return py::make_tuple(
      array_of(std::move(of), "i", 4, {count, 2}), array_of(std::move(ids), "q", 8, {count}),
      array_of(std::move(middles), "d", 8, {count, 3}), array_of(std::move(normals), "d", 8, {count, 3}),
      array_of(std::move(depths), "d", 8, {count}), array_of(std::move(sizes), "i", 4, {count}),
      array_of(std::move(points), "d", 8, {count, 4, 2, 3}), array_of(std::move(point_depths), "d", 8, {count, 4}));
}

}  // namespace

void bind_scenes(py::module_& module) {
  bind_hold<false>(module, "Reading");
  bind_hold<true>(module, "Writing");
  py::class_<SharedScene>(module, "Scene")
      .def(py::init<>())
      .def_readwrite("triangles", &SharedScene::triangles)
      .def("forget_threads", &SharedScene::forget_threads)
      .def("add",
           [](SharedScene& shared, const Mesh& mesh, py::handle pose, std::uint32_t group) {
             const Pose at = pose_of(pose, "pose");
             return to_number(unlocked(shared, [&](Scene& scene) { return scene.add(mesh, at, group); }));
           })
      .def("set_pose", [](SharedScene& shared, std::uint64_t id,
                          py::handle matrix) { unwrap(shared.scene.set_pose(to_id(id), pose_of(matrix, "pose"))); })
      .def("set_poses",
           [](SharedScene& shared, const std::vector<std::uint64_t>& numbers, py::handle matrices) {
             const std::vector<ObjectId> ids = to_ids(numbers);
             const std::vector<Pose> poses = poses_of(View(matrices), "poses");
             unlocked(shared, [&](Scene& scene) { return scene.set_poses(ids, poses); });
           })
      .def("set_mesh",
           [](SharedScene& shared, std::uint64_t id, const Mesh& mesh, py::handle pose) {
             const Pose at = pose_of(pose, "pose");
             unlocked(shared, [&](Scene& scene) { return scene.set_mesh(to_id(id), mesh, at); });
           })
      .def("remove", [](SharedScene& shared,
                        std::uint64_t id) { unlocked(shared, [&](Scene& scene) { return scene.remove(to_id(id)); }); })
      .def("ignore",
           [](SharedScene& shared, std::uint64_t a, std::uint64_t b, bool ignored) {
             unlocked(shared, [&](Scene& scene) {
               return ignored ? scene.ignore(to_id(a), to_id(b)) : scene.unignore(to_id(a), to_id(b));
             });
           })
      .def("set_filter",
           [](SharedScene& shared, std::uint64_t id, std::uint64_t category, std::uint64_t mask) {
             unwrap(shared.scene.set_filter(to_id(id), {category, mask}));
           })
      .def("self", [](SharedScene& shared, std::uint64_t id, bool on) { unwrap(shared.scene.self(to_id(id), on)); })
      .def("pose", &pose_of_object)
      .def("update", [](SharedScene& shared,
                        int threads) { unlocked(shared, [&](Scene& scene) { return scene.update(threads); }); })
      .def("collide", &collide_all)
      .def("collide_with", &collide_one)
      .def("collide_with_mesh", &collide_mesh)
      .def("touches_with", &touches_mesh)
      .def("touches_any", &touches_any)
      .def("collide_configurations", &collide_configurations)
      .def("distance_configurations", &distance_configurations)
      .def("first_touching", &first_touching)
      .def("distance", &distance_of_all)
      .def("closest", &closest_pairs);
  py::class_<SharedManifolds>(module, "ContactManifolds").def(py::init<>()).def("update", &update_manifolds);
}

}  // namespace impinge::python
