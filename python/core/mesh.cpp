// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Meshes, and queries on two of them.
#include "impinge/mesh.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "impinge/collide.hpp"
#include "impinge/measures.hpp"
#include "impinge/regions.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"

namespace impinge::python {

QueryOptions::QueryOptions(bool first_, std::uint64_t limit_, std::uint8_t kinds_, int threads_, std::string backend_,
                           std::string device_, bool by_index_)
    : first(first_),
      limit(limit_),
      kinds(kinds_),
      threads(threads_),
      backend(std::move(backend_)),
      device(std::move(device_)),
      by_index(by_index_) {}

Options QueryOptions::with(std::stop_token stop) const {
  return {.find = first ? Options::Find::first : Options::Find::all,
          .limit = limit,
          .kinds = kinds,
          .threads = threads,
          .backend = backend,
          .device = device,
          .adjacency = by_index ? Adjacency::by_index : Adjacency::by_position,
          .stop = std::move(stop)};
}

py::tuple contacts_tuple(Contacts&& contacts) {
  const auto rows = static_cast<py::ssize_t>(contacts.objects.size());
  const auto count = static_cast<py::ssize_t>(contacts.kinds.size());
  return py::make_tuple(array_of(std::move(contacts.objects), "i", 4, {rows, 2}),
                        array_of(std::move(contacts.offsets), "q", 8, {rows + 1}),
                        array_of(std::move(contacts.triangles), "i", 4, {count, 2}),
                        array_of(std::move(contacts.kinds), "B", 1, {count}), contacts.truncated, contacts.hash,
                        contacts.warnings);
}

py::object nearest_tuple(const Nearest& nearest) {
  if (std::isinf(nearest.distance)) return py::none();
  return py::make_tuple(nearest.distance, nearest.error,
                        array_of(std::vector<Point>{nearest.a, nearest.b}, "d", 8, {2, 3}),
                        py::make_tuple(nearest.triangle_a, nearest.triangle_b));
}

namespace {

Mesh make_mesh(py::handle vertices, py::handle triangles, std::uint32_t leaf_size, bool vertices_are_single,
               bool single) {
  const View xyz(vertices), indices(triangles);
  const TreeConfig tree{leaf_size};
  const auto index = indices.as<std::uint32_t>();
  const auto make = [&](auto coordinates) {
    const Unlocked released;
    if constexpr (std::is_same_v<decltype(coordinates), std::span<const float>>) {
      return Mesh::create(coordinates, index, tree);
    } else {
      return Mesh::create(coordinates, index, tree, single ? Precision::single : Precision::whole);
    }
  };
  return vertices_are_single ? unwrap(make(xyz.as<float>())) : unwrap(make(xyz.as<double>()));
}

/// The mesh's own numbers, which nobody may change.
template <class T>
Array numbers_of(const Mesh& mesh, std::span<const T> values, const char* format, py::ssize_t itemsize) {
  return {std::make_shared<Mesh>(mesh),
          const_cast<T*>(values.data()),
          format,
          itemsize,
          {static_cast<py::ssize_t>(values.size()), static_cast<py::ssize_t>(sizeof(T)) / itemsize},
          true};
}

Affine affine_of(const View& matrix) {
  const Pose rows = poses_of(matrix, "matrix").at(0);
  return {rows.R, rows.t};
}

/// The matrices of `make(k)` for each k below count; an error names its place.
template <class Make>
Array poses_made(std::size_t count, const char* what, Make make) {
  std::vector<Pose> poses(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Result<Pose> made = make(k);
    const std::string which = count == 1 ? "" : '[' + std::to_string(k) + ']';
    if (!made) raise({made.error().code, what + which + ": " + made.error().message});
    poses[k] = *made;
  }
  return matrices_of(poses);
}

Array nearest_poses(py::handle matrices) {
  const std::vector<Pose> maps = poses_of(View(matrices), "matrix");
  return poses_made(maps.size(), "matrix", [&](std::size_t k) { return Pose::nearest({maps[k].R, maps[k].t}); });
}

Array poses_of_quaternions(py::handle quaternions, py::handle translations) {
  const auto turns = copy_of<Quaternion>(quaternions);
  const auto shifts = copy_of<std::array<double, 3>>(translations);
  return poses_made(turns.size(), "quaternion",
                    [&](std::size_t k) { return Pose::from_quaternion(turns[k], shifts.at(k)); });
}

py::tuple collide_pair(const Pair& p, const QueryOptions& options, const Stop* stop) {
  return contacts_tuple(
      run_pair(p, stop, [&](std::stop_token token) { return collide(p.a, p.at, p.b, p.bt, options.with(token)); }));
}

/// On several threads only where they are worth it.
bool touches_pair(const Pair& p, int threads, const Stop* stop) {
  const bool small = p.a.triangle_count() + p.b.triangle_count() < kMayTakeLong;
  if (threads == 1 || (threads == 0 && small))
    return run_pair(p, stop, [&](const std::stop_token& token) { return touches(p.a, p.at, p.b, p.bt, token); });
  return !run_pair(p, stop, [&](std::stop_token token) {
            return collide(p.a, p.at, p.b, p.bt, {.find = Options::Find::first, .threads = threads, .stop = token});
          }).kinds.empty();
}

py::tuple collide_self(const Mesh& mesh, py::handle pose, const QueryOptions& options, const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  return contacts_tuple(unwrap(run(stop, mesh.triangle_count(), [&](std::stop_token token) {
    return self_collide(mesh, at, options.with(token));
  })));
}

py::tuple collide_at_poses(const Mesh& a, py::handle poses_a, const Mesh& b, py::handle poses_b,
                           const QueryOptions& options, const Stop* stop) {
  const std::vector<Pose> at = poses_of(View(poses_a), "poses_a"), bt = poses_of(View(poses_b), "poses_b");
  const std::size_t triangles = a.triangle_count() + b.triangle_count();
  return contacts_tuple(unwrap(run(stop, triangles * std::max(at.size(), bt.size()), [&](std::stop_token token) {
    return collide_poses(a, at, b, bt, options.with(token));
  })));
}

py::object distance_of_pair(const Pair& p, const DistanceOptions& options, const Stop* stop) {
  return nearest_tuple(
      run_pair(p, stop, [&](std::stop_token token) { return distance(p.a, p.at, p.b, p.bt, options.with(token)); }));
}

bool pair_closer_than(const Pair& p, double limit, int threads, const Stop* stop) {
  return run_pair(p, stop, [&](std::stop_token token) {
    return closer_than(p.a, p.at, p.b, p.bt, limit, {.threads = threads, .stop = token});
  });
}

/// What `make()` makes of a mesh whose whole tree it needs. It hears no stop: one is heard before the tree, and before
/// the rest.
template <class Make>
auto with_tree(const Mesh& mesh, int threads, const Stop* stop, Make make) {
  return run(stop, mesh.triangle_count(), [&](const std::stop_token& token) -> decltype(make()) {
    if (token.stop_requested()) return kStopped;
    if (auto made = mesh.build_tree(threads); !made) return made.error();
    if (token.stop_requested()) return kStopped;
    return make();
  });
}

Array locate_points(const PointLocator& locator, py::handle points, int threads, const Stop* stop) {
  const auto xyz = copy_of<Point>(points);
  auto found = unwrap(run(stop, xyz.size(), [&](std::stop_token token) {
    return locator.locate(xyz, {.threads = threads, .stop = token});
  }));
  const auto count = static_cast<py::ssize_t>(found.size());
  return array_of(std::move(found), "B", 1, {count});
}

py::tuple depth_of_overlap(const Pair& p, double precision, int threads, const Stop* stop) {
  const OverlapDepth depth = run_pair(p, stop, [&](std::stop_token token) {
    return overlap_depth(p.a, p.at, p.b, p.bt, precision, {.threads = threads, .stop = token});
  });
  return py::make_tuple(depth.a_in_b.lo, depth.a_in_b.hi, depth.b_in_a.lo, depth.b_in_a.hi);
}

py::tuple volume_of_overlap(const Pair& p, int threads, const Stop* stop) {
  const OverlapVolume volume = run_pair(p, stop, [&](std::stop_token token) {
    return overlap_volume(p.a, p.at, p.b, p.bt, {.threads = threads, .stop = token});
  });
  return py::make_tuple(volume.volume, volume.error);
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<QueryOptions>(module, "Options")
      .def(py::init<bool, std::uint64_t, std::uint8_t, int, std::string, std::string, bool>());
  py::class_<DistanceOptions>(module, "DistanceOptions").def(py::init<double, double, int>());
  py::class_<Mesh>(module, "Mesh")
      .def(py::init(&make_mesh))
      .def("vertices", [](const Mesh& mesh) { return numbers_of(mesh, mesh.vertices(), "d", 8); })
      .def("triangles", [](const Mesh& mesh) { return numbers_of(mesh, mesh.triangles(), "i", 4); })
      .def("edges",
           [](const Mesh& mesh) {
             const auto edges = [&] {
               const Unlocked released;
               return mesh.edges();
             }();
             return numbers_of(mesh, edges, "i", 4);
           })
      .def("is_single", [](const Mesh& mesh) { return mesh.precision() == Precision::single; })
      .def("key", [](const Mesh& mesh) { return reinterpret_cast<std::uintptr_t>(mesh.vertices().data()); })
      .def("triangle_count", &Mesh::triangle_count)
      .def("transformed",
           [](const Mesh& mesh, py::handle matrix) {
             const Affine map = affine_of(View(matrix));
             return unwrap([&] {
               const Unlocked released;
               return mesh.transformed(map);
             }());
           })
      .def("deformed",
           [](const Mesh& mesh, py::handle vertices, const Stop* stop) {
             const View xyz(vertices);
             // No `with_tree`: only a tree that is largely made already is worth a refit, and `deformed` sees to that.
             return unwrap(run(stop, mesh.triangle_count(), [&](const std::stop_token& token) -> Result<Mesh> {
               if (token.stop_requested()) return kStopped;
               return mesh.deformed(xyz.as<double>());
             }));
           })
      .def("build_tree",
           [](const Mesh& mesh, int threads) {
             unwrap([&] {
               const Unlocked released;
               return mesh.build_tree(threads);
             }());
           })
      .def("memory_bytes", &Mesh::memory_bytes);
  module.def("nearest_poses", &nearest_poses);
  module.def("poses_of_quaternions", &poses_of_quaternions);
  module.def("off_rotation", &off_rotation);
  bind_pair(module, "collide", &collide_pair);
  bind_pair(module, "touches", &touches_pair);
  module.def("self_collide", &collide_self);
  module.def("collide_poses", &collide_at_poses);
  bind_pair(module, "distance", &distance_of_pair);
  bind_pair(module, "closer_than", &pair_closer_than);
  py::class_<PointLocator>(module, "PointLocator")
      .def(py::init([](const Mesh& mesh, py::handle pose, int threads, const Stop* stop) {
        const Pose at = pose_of(pose, "pose");
        return unwrap(with_tree(mesh, threads, stop, [&] { return PointLocator::create(mesh, at, threads); }));
      }))
      .def("locate", &locate_points);
  bind_pair(module, "overlap_depth", &depth_of_overlap);
  bind_pair(module, "overlap_volume", &volume_of_overlap);
}

}  // namespace impinge::python
