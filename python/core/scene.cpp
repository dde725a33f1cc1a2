// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "python/core/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

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
    const py::gil_scoped_release released;
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
    const py::gil_scoped_release released;
    return change(shared.scene);
  }());
}

py::object to_python(const std::optional<ObjectDistance>& found) {
  if (!found) return py::none();
  return py::make_tuple(found->objects[0], found->objects[1], nearest_tuple(found->nearest));
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

bool touches_mesh(SharedScene& shared, const Mesh& mesh, py::handle pose) {
  const Pose at = pose_of(pose, "pose");
  const std::size_t size = size_of_visit(shared, mesh, true);
  return unwrap(run(nullptr, size, [&](std::stop_token token) {
    return shared.scene.touches_with(mesh, at, {.threads = size < kMayTakeLong ? 1 : 0, .stop = token});
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

Array collide_configurations(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses, int threads,
                             const Stop* stop) {
  const Path path(ids, poses);
  Configurations found = unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.collide_configurations(path.ids, path.poses, {.threads = threads, .stop = token});
  }));
  const auto count = static_cast<py::ssize_t>(found.touches.size());
  return array_of(std::move(found.touches), "?", 1, {count});
}

std::optional<std::size_t> first_touching(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                                          int threads, const Stop* stop) {
  const Path path(ids, poses);
  return unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.first_touching(path.ids, path.poses, {.threads = threads, .stop = token});
  }));
}

py::object distance_of_all(SharedScene& shared, std::optional<std::uint64_t> id, double stop_above, int threads,
                           const Stop* stop) {
  return to_python(unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    const MeasureOptions options{.threads = threads, .stop = token, .stop_above = stop_above};
    return id ? shared.scene.distance_with(to_id(*id), options) : shared.scene.distance(options);
  })));
}

Array distance_configurations(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                              double stop_above, int threads, const Stop* stop) {
  const Path path(ids, poses);
  const auto found = unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene.distance_configurations(path.ids, path.poses,
                                                {.threads = threads, .stop = token, .stop_above = stop_above});
  }));
  std::vector<double> distances(found.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k]) distances[k] = found[k]->nearest.distance;
  return array_of(std::move(distances), "d", 8, {static_cast<py::ssize_t>(found.size())});
}

Array pose_of_object(SharedScene& shared, std::uint64_t id) { return matrix_of(unwrap(shared.scene.pose(to_id(id)))); }

}  // namespace

void bind_scenes(py::module_& module) {
  bind_hold<false>(module, "Reading");
  bind_hold<true>(module, "Writing");
  py::class_<SharedScene>(module, "Scene")
      .def(py::init<>())
      .def_readwrite("triangles", &SharedScene::triangles)
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
      .def("pose", &pose_of_object)
      .def("update", [](SharedScene& shared,
                        int threads) { unlocked(shared, [&](Scene& scene) { return scene.update(threads); }); })
      .def("collide", &collide_all)
      .def("collide_with", &collide_one)
      .def("collide_with_mesh", &collide_mesh)
      .def("touches_mesh", &touches_mesh)
      .def("touches_any", &touches_any)
      .def("collide_configurations", &collide_configurations)
      .def("distance_configurations", &distance_configurations)
      .def("first_touching", &first_touching)
      .def("distance", &distance_of_all);
}

}  // namespace impinge::python
