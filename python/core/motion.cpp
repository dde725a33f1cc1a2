// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Impacts of moving meshes and scenes, sweeps of rigid bodies, and the exact predicates on arrays of points.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "impinge/impacts.hpp"
#include "impinge/predicates.hpp"
#include "impinge/scene.hpp"
#include "impinge/sweeps.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"
#include "python/core/scene.hpp"

namespace impinge::python {
namespace {

py::object to_python(const std::optional<Interval>& time) {
  return time ? py::object(py::make_tuple(time->lo, time->hi)) : py::none();
}

/// `MotionOptions` as Python hands them over: (earliest, end, by_index, separation, limit, threads).
struct MotionChoice {
  bool earliest;
  double end;
  bool by_index;
  double separation;
  std::uint64_t limit;
  int threads;

  /// For `run`: with a separation a single pair can take long.
  [[nodiscard]] std::size_t size_of(std::size_t triangles) const { return separation > 0 ? kMayTakeLong : triangles; }
  [[nodiscard]] MotionOptions with(std::stop_token stop) const {
    return {.earliest = earliest,
            .end = end,
            .separation = separation,
            .adjacency = by_index ? Adjacency::by_index : Adjacency::by_position,
            .limit = limit,
            .threads = threads,
            .stop = std::move(stop)};
  }
};

/// (features, ids, times, points, normals, earliest, truncated) of `Impacts` and `SceneImpacts`.
template <class Found>
py::tuple impacts_tuple(const Found& found) {
  std::vector<Feature> features;
  std::vector<std::array<std::uint32_t, 2>> ids;
  std::vector<Interval> times;
  std::vector<Point> points, normals;
  for (const Impact& impact : found.impacts) {
    features.push_back(impact.feature);
    ids.push_back({impact.a, impact.b});
    times.push_back(impact.time);
    points.push_back(impact.point);
    normals.push_back(impact.normal);
  }
  const auto count = static_cast<py::ssize_t>(found.impacts.size());
  return py::make_tuple(array_of(std::move(features), "B", 1, {count}), array_of(std::move(ids), "i", 4, {count, 2}),
                        array_of(std::move(times), "d", 8, {count, 2}), array_of(std::move(points), "d", 8, {count, 3}),
                        array_of(std::move(normals), "d", 8, {count, 3}), to_python(found.earliest), found.truncated);
}

py::tuple impacts_of(const Moving& a, const Moving* b, const MotionChoice& options, const Stop* stop) {
  const std::size_t size = a.from.triangle_count() + (b != nullptr ? b->from.triangle_count() : 0);
  return impacts_tuple(unwrap(run(stop, options.size_of(size), [&](std::stop_token token) {
    return b != nullptr ? find_impacts(a, *b, options.with(token)) : find_impacts(a, options.with(token));
  })));
}

py::tuple impacts_of_scene(SharedScene& shared, const MotionChoice& options, const Stop* stop) {
  SceneImpacts found = unwrap(run(stop, options.size_of(shared.triangles), [&](std::stop_token token) {
    return shared.scene->find_impacts(options.with(token));
  }));
  const auto rows = static_cast<py::ssize_t>(found.objects.size());
  const py::tuple impacts = impacts_tuple(found);
  return py::make_tuple(array_of(std::move(found.objects), "i", 4, {rows, 2}),
                        array_of(std::move(found.offsets), "q", 8, {rows + 1}), found.hash, impacts);
}

py::tuple step_of(const std::vector<Moving>& meshes, const MotionChoice& options, const Stop* stop) {
  std::size_t size = 0;
  for (const Moving& mesh : meshes) size += mesh.from.triangle_count();
  Step found = unwrap(run(stop, options.size_of(size),
                          [&](std::stop_token token) { return collision_free_step(meshes, options.with(token)); }));
  return py::make_tuple(found.time, found.ends);
}

Sweep make_sweep(py::handle start, py::handle to, bool straight, int turns) {
  return {pose_of(start, "start"), pose_of(to, "to"), straight ? Sweep::Path::straight : Sweep::Path::screw, turns};
}

Array poses_at(const Sweep& sweep, py::handle times) {
  const auto moments = copy_of<double>(times);
  std::vector<Pose> poses;
  for (const double time : moments) poses.push_back(unwrap(pose_at(sweep, time)));
  return matrices_of(poses);
}

py::object first_meeting(const Mesh& a, const Sweep& sweep_a, const Mesh& b, const Sweep& sweep_b, double tolerance,
                         int threads, const Stop* stop) {
  const auto found = unwrap(run(stop, kMayTakeLong, [&](std::stop_token token) {
    return time_of_impact(a, sweep_a, b, sweep_b, tolerance, {.threads = threads, .stop = std::move(token)});
  }));
  if (!found) return py::none();
  return py::make_tuple(to_python(std::optional(found->time)), found->gap,
                        array_of(std::vector<Point>{found->a, found->b}, "d", 8, {2, 3}));
}

/// What `predicate` says of each row of so many points.
template <std::size_t kPoints, class Predicate>
auto each_row(py::handle points, const Stop* stop, Predicate predicate) {
  const auto rows = copy_of<std::array<Point, kPoints>>(points);
  std::vector<decltype(predicate({}))> answers(rows.size());
  unwrap(run(stop, answers.size(), [&](std::stop_token token) -> Result<void> {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (token.stop_requested()) return kStopped;
      answers[i] = predicate(rows[i]);
    }
    return {};
  }));
  return answers;
}

template <std::size_t kPoints, class Predicate>
void bind_sign(py::module_& module, const char* name, Predicate predicate) {
  module.def(name, [predicate](py::handle points, const Stop* stop) {
    auto signs = each_row<kPoints>(points, stop, predicate);
    const auto count = static_cast<py::ssize_t>(signs.size());
    return array_of(std::move(signs), "b", 1, {count});
  });
}

template <class Predicate>
void bind_impact(py::module_& module, const char* name, Predicate predicate) {
  module.def(name, [predicate](py::handle points, const Stop* stop) {
    constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
    auto times = each_row<8>(points, stop, [&](const std::array<Point, 8>& row) {
      return predicate(row).value_or(Interval{kNever, kNever});
    });
    const auto count = static_cast<py::ssize_t>(times.size());
    return array_of(std::move(times), "d", 8, {count, 2});
  });
}

}  // namespace

void bind_motion(py::module_& module) {
  py::class_<Moving>(module, "Moving").def(py::init<Mesh, Mesh>());
  py::class_<MotionChoice>(module, "MotionOptions")
      .def(py::init([](bool earliest, double end, bool by_index, double separation, std::uint64_t limit, int threads) {
        return MotionChoice{earliest, end, by_index, separation, limit, threads};
      }));
  module.def("find_impacts", &impacts_of);
  module.def("impacts_of_scene", &impacts_of_scene);
  module.def("collision_free_step", &step_of);
  py::class_<Sweep>(module, "Sweep").def(py::init(&make_sweep));
  module.def("poses_at", &poses_at);
  module.def("time_of_impact", &first_meeting);
  bind_sign<4>(module, "orient3d", [](const std::array<Point, 4>& p) {
    return static_cast<std::int8_t>(orient3d(p[0], p[1], p[2], p[3]));
  });
  bind_sign<6>(module, "triangles_meet", [](const std::array<Point, 6>& p) {
    const auto kind = intersects(Triangle{p[0], p[1], p[2]}, Triangle{p[3], p[4], p[5]});
    return static_cast<std::int8_t>(kind ? static_cast<int>(*kind) : -1);
  });
  bind_impact(module, "vertex_face_impact", [](const std::array<Point, 8>& p) {
    return vertex_face_impact(p[0], {p[1], p[2], p[3]}, p[4], {p[5], p[6], p[7]});
  });
  bind_impact(module, "edge_edge_impact", [](const std::array<Point, 8>& p) {
    return edge_edge_impact({p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]});
  });
}

}  // namespace impinge::python
