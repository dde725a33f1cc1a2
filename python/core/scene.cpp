// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "python/core/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "impinge/contact_history.hpp"
#include "impinge/manifolds.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"

namespace impinge::python {

Scene& SharedScene::own() {
  if (scene.use_count() > 1) scene = std::make_shared<Scene>(*scene);
  std::atomic_thread_fence(std::memory_order_acquire);  // after whoever kept it has let go
  return *scene;
}

void SharedScene::forget_threads_of_parent() {
  if (process != process_number()) {
    new (&mutex) std::shared_mutex;
    process = process_number(), spoilt = changing;
  }
  if (spoilt)
    raise({Code::bad_option,
           "this scene was being changed by another thread when the process was forked, and is half changed here; fork "
           "while no thread changes it, or hand it to the child by pickle"});
}

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
  std::optional<int> threads{};  ///< for a query: on so many, what is near what is found out first

  [[nodiscard]] SharedScene& shared() const { return scene.cast<SharedScene&>(); }
  void enter() {
    SharedScene& held = shared();
    held.forget_threads_of_parent();
    if (threads && held.stale) update(held);
    lock<kAlone>(held.mutex);
    if (kAlone) held.changing = true;
  }
  void exit(const py::args&) {
    SharedScene& held = shared();
    if (!kAlone) return held.mutex.unlock_shared();
    held.stale = true, held.changing = false;
    held.mutex.unlock();
  }

 private:
  template <bool kForChange>
  static void lock(std::shared_mutex& mutex) {
    if (kForChange ? mutex.try_lock() : mutex.try_lock_shared()) return;
    const Unlocked released;
    kForChange ? mutex.lock() : mutex.lock_shared();
  }
  void update(SharedScene& held) const {
    lock<true>(held.mutex);
    const std::lock_guard locked(held.mutex, std::adopt_lock);
    held.changing = true;
    const Result<void> updated = [&] {
      const Unlocked released;
      return held.own().update(*threads);
    }();
    held.changing = false;
    unwrap(updated);
    held.stale = false;
  }
};

template <bool kAlone>
py::class_<Hold<kAlone>> bind_hold(py::module_& module, const char* name) {
  return py::class_<Hold<kAlone>>(module, name)
      .def(py::init([](py::object scene) { return Hold<kAlone>{std::move(scene)}; }))
      .def("__enter__", &Hold<kAlone>::enter)
      .def("__exit__", &Hold<kAlone>::exit);
}

/// What `change(scene)` returns, with the interpreter's lock released.
template <class Change>
auto unlocked(SharedScene& shared, Change change) {
  return unwrap([&] {
    const Unlocked released;
    return change(shared.own());
  }());
}

py::tuple to_python(const ObjectDistance& found) {
  return py::make_tuple(found.objects[0], found.objects[1], nearest_tuple(found.nearest));
}

py::tuple collide_all(SharedScene& shared, const QueryOptions& options, const Stop* stop) {
  return contacts_tuple(unwrap(
      run(stop, shared.triangles, [&](std::stop_token token) { return shared.scene->collide(options.with(token)); })));
}

py::tuple collide_one(SharedScene& shared, std::uint64_t id, const QueryOptions& options, const Stop* stop) {
  return contacts_tuple(unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return shared.scene->collide_with(to_id(id), options.with(token));
  })));
}

/// Of a query of a mesh and the scene. The first contact with each object near it is a matter of microseconds, so such
/// an object counts as one triangle.
std::size_t size_of_visit(const SharedScene& shared, const Mesh& mesh, bool first) {
  return mesh.triangle_count() + (first ? shared.scene->size() : shared.triangles);
}

py::tuple collide_mesh(SharedScene& shared, const Mesh& mesh, py::handle pose, const QueryOptions& options,
                       const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  return contacts_tuple(unwrap(run(stop, size_of_visit(shared, mesh, options.first), [&](std::stop_token token) {
    return shared.scene->collide_with(mesh, at, options.with(token));
  })));
}

bool touches_mesh(SharedScene& shared, const Mesh& mesh, py::handle pose, int threads, const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  const std::size_t size = size_of_visit(shared, mesh, true);
  if (threads == 0 && size < kMayTakeLong) threads = 1;
  return unwrap(run(stop, size, [&](std::stop_token token) {
    return shared.scene->touches_with(mesh, at, {.threads = threads, .stop = token});
  }));
}

/// The same at each of many poses, shared among threads.
Array touches_mesh_at(SharedScene& shared, const Mesh& mesh, py::handle matrices, const Stop* stop) {
  const std::vector<Pose> poses = poses_of(View(matrices), "poses");
  std::vector<std::uint8_t> touches(poses.size());
  unwrap(run(stop, size_of_visit(shared, mesh, true) * poses.size(), [&](std::stop_token token) -> Result<void> {
    std::optional<Error> problem;
    std::mutex mutex;
    tbb::task_group_context together;
    const auto look = [&](std::size_t k) {
      const auto found = shared.scene->touches_with(mesh, poses[k], {.threads = 1, .stop = token});
      if (found.has_value()) {
        touches[k] = *found;
      } else if (const std::lock_guard lock(mutex); !problem) {
        problem = found.error();
        together.cancel_group_execution();
      }
    };
    tbb::parallel_for(std::size_t{0}, poses.size(), look, together);
    if (problem) return *problem;
    return {};
  }));
  return array_of(std::move(touches), "?", 1, {static_cast<py::ssize_t>(poses.size())});
}

bool touches_any(SharedScene& shared, int threads, const Stop* stop) {
  return unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return shared.scene->touches_any({.threads = threads, .stop = token});
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
    return shared.scene->collide_configurations(path.ids, path.poses,
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
    return shared.scene->first_touching(path.ids, path.poses, {.threads = threads, .stop = token});
  }));
}

py::object distance_of_all(SharedScene& shared, std::optional<std::uint64_t> id, const DistanceOptions& options,
                           const Stop* stop) {
  const auto found = unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return id ? shared.scene->distance_with(to_id(*id), options.with(token))
              : shared.scene->distance(options.with(token));
  }));
  return found ? py::object(to_python(*found)) : py::none();
}

py::list closest_pairs(SharedScene& shared, std::size_t count, const DistanceOptions& options, const Stop* stop) {
  const auto found = unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    return shared.scene->closest(count, options.with(token));
  }));
  py::list all;
  for (const ObjectDistance& pair : found) all.append(to_python(pair));
  return all;
}

Array distance_configurations(SharedScene& shared, const std::vector<std::uint64_t>& ids, py::handle poses,
                              const DistanceOptions& options, const Stop* stop) {
  const Path path(ids, poses);
  const auto found = unwrap(run(stop, path.size(shared), [&](std::stop_token token) {
    return shared.scene->distance_configurations(path.ids, path.poses, options.with(token));
  }));
  std::vector<double> distances(found.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k]) distances[k] = found[k]->nearest.distance;
  return array_of(std::move(distances), "d", 8, {static_cast<py::ssize_t>(found.size())});
}

Array pose_of_object(SharedScene& shared, std::uint64_t id) { return matrix_of(unwrap(shared.scene->pose(to_id(id)))); }

/// What one frame after the other uses.
struct SharedManifolds {
  ContactManifolds manifolds;
  Exclusive mutex;
};

struct SharedHistory {
  ContactHistory history;
  Exclusive mutex;
};

/// Refuses rows that do not fit together. Whether the scene has the objects that they name, it says itself.
void check_rows(std::size_t rows, const std::vector<std::uint64_t>& offsets, std::size_t count, const char* what) {
  if (offsets.size() != rows + 1 || offsets.front() != 0 || offsets.back() != count || !std::ranges::is_sorted(offsets))
    raise({Code::bad_option,
           std::string("the arrays of the ") + what + " do not fit together; give " + what + " as a scene found them"});
}

Contacts contacts_of(py::handle objects, py::handle offsets, py::handle pairs, bool truncated) {
  Contacts contacts;
  contacts.objects = copy_of<std::array<std::uint32_t, 2>>(objects);
  contacts.offsets = copy_of<std::uint64_t>(offsets);
  contacts.triangles = copy_of<TrianglePair>(pairs);
  contacts.truncated = truncated;
  check_rows(contacts.objects.size(), contacts.offsets, contacts.triangles.size(), "contacts");
  return contacts;
}

py::tuple update_manifolds(SharedManifolds& shared, SharedScene& scene, py::handle objects, py::handle offsets,
                           py::handle pairs, bool truncated) {
  shared.mutex.check("ContactManifolds");
  const Contacts contacts = contacts_of(objects, offsets, pairs, truncated);
  const auto found =
      unwrap(run(nullptr, contacts.triangles.size(), [&](std::stop_token) -> Result<std::vector<Manifold>> {
        const std::lock_guard lock(shared.mutex);
        const auto all = shared.manifolds.update(*scene.scene, contacts);
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

/// (kind, object, object) of each event, objects by their ids. Of impacts (objects, offsets, times, truncated), or
/// None. The Python above holds the history's mutex.
Array update_history(SharedHistory& shared, SharedScene& scene, py::handle objects, py::handle offsets,
                     py::handle pairs, bool truncated, const std::optional<py::tuple>& met) {
  const Contacts contacts = contacts_of(objects, offsets, pairs, truncated);
  SceneImpacts between;
  if (met) {
    between.objects = copy_of<std::array<std::uint32_t, 2>>((*met)[0]);
    between.offsets = copy_of<std::uint64_t>((*met)[1]);
    for (const Interval& time : copy_of<Interval>((*met)[2])) between.impacts.push_back({.time = time});
    between.truncated = (*met)[3].cast<bool>();
    check_rows(between.objects.size(), between.offsets, between.impacts.size(), "impacts");
  }
  std::vector<std::array<std::uint64_t, 3>> rows;
  for (const ContactEvent& event : unwrap(shared.history.update(*scene.scene, contacts, met ? &between : nullptr)))
    rows.push_back({static_cast<std::uint64_t>(event.kind), to_number(event.objects[0]), to_number(event.objects[1])});
  const auto count = static_cast<py::ssize_t>(rows.size());
  return array_of(std::move(rows), "q", 8, {count, 3});
}

}  // namespace

void bind_scenes(py::module_& module) {
  bind_hold<false>(module, "Reading").def(py::init([](py::object scene, int threads) {
    return Hold<false>{std::move(scene), threads};
  }));
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
                          py::handle matrix) { unwrap(shared.own().set_pose(to_id(id), pose_of(matrix, "pose"))); })
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
             unwrap(shared.own().set_filter(to_id(id), {category, mask}));
           })
      .def("self", [](SharedScene& shared, std::uint64_t id, bool on) { unwrap(shared.own().self(to_id(id), on)); })
      .def("pose", &pose_of_object)
      .def("step", [](SharedScene& shared) { shared.own().step(); })
      .def("collide", &collide_all)
      .def("collide_with", &collide_one)
      .def("collide_with_mesh", &collide_mesh)
      .def("touches_with", &touches_mesh)
      .def("touches_with_at", &touches_mesh_at)
      .def("touches_any", &touches_any)
      .def("collide_configurations", &collide_configurations)
      .def("distance_configurations", &distance_configurations)
      .def("first_touching", &first_touching)
      .def("distance", &distance_of_all)
      .def("closest", &closest_pairs);
  py::class_<SharedHistory>(module, "ContactHistory")
      .def(py::init<>())
      .def("__enter__",
           [](SharedHistory& shared) {
             shared.mutex.check("ContactHistory");
             const Unlocked released;
             shared.mutex.lock();
           })
      .def("__exit__", [](SharedHistory& shared, const py::args&) { shared.mutex.unlock(); })
      .def("update", &update_history);
  py::class_<SharedManifolds>(module, "ContactManifolds").def(py::init<>()).def("update", &update_manifolds);
}

}  // namespace impinge::python
