// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Impacts of moving meshes, and the exact predicates on arrays of points.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "impinge/impacts.hpp"
#include "impinge/predicates.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"

namespace impinge::python {
namespace {

py::object to_python(const std::optional<Interval>& time) {
  return time ? py::object(py::make_tuple(time->lo, time->hi)) : py::none();
}

py::tuple impacts_of(const Moving& a, const Moving* b, bool earliest, double end, bool by_index, std::uint64_t limit,
                     int threads, const Stop* stop) {
  const std::size_t size = a.from.triangle_count() + (b != nullptr ? b->from.triangle_count() : 0);
  const Impacts found = unwrap(run(stop, size, [&](std::stop_token token) {
    const MotionOptions options{.earliest = earliest,
                                .end = end,
                                .adjacency = by_index ? Adjacency::by_index : Adjacency::by_position,
                                .limit = limit,
                                .threads = threads,
                                .stop = token};
    return b != nullptr ? find_impacts(a, *b, options) : find_impacts(a, options);
  }));
  const std::vector<Impact>& impacts = found.impacts;
  std::vector<Feature> features;
  std::vector<std::array<std::uint32_t, 2>> ids;
  std::vector<Interval> times;
  std::vector<Point> points, normals;
  for (const Impact& impact : impacts) {
    features.push_back(impact.feature);
    ids.push_back({impact.a, impact.b});
    times.push_back(impact.time);
    points.push_back(impact.point);
    normals.push_back(impact.normal);
  }
  const auto count = static_cast<py::ssize_t>(impacts.size());
  return py::make_tuple(array_of(std::move(features), "B", 1, {count}), array_of(std::move(ids), "i", 4, {count, 2}),
                        array_of(std::move(times), "d", 8, {count, 2}), array_of(std::move(points), "d", 8, {count, 3}),
                        array_of(std::move(normals), "d", 8, {count, 3}), to_python(found.earliest), found.truncated);
}

py::tuple step_of(const std::vector<Moving>& meshes, double end, bool by_index, int threads, const Stop* stop) {
  std::size_t size = 0;
  for (const Moving& mesh : meshes) size += mesh.from.triangle_count();
  Step found = unwrap(run(stop, size, [&](std::stop_token token) {
    return collision_free_step(meshes, {.end = end,
                                        .adjacency = by_index ? Adjacency::by_index : Adjacency::by_position,
                                        .threads = threads,
                                        .stop = token});
  }));
  return py::make_tuple(found.time, found.ends);
}

/// What `predicate` says of each row of so many points.
template <std::size_t kPoints, class Predicate>
auto each_row(py::handle points, const Stop* stop, Predicate predicate) {
  const auto rows = copy_of<std::array<Point, kPoints>>(points);
  std::vector<decltype(predicate({}))> answers(rows.size());
  unwrap(run(stop, answers.size(), [&](std::stop_token token) -> Result<void> {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (token.stop_requested()) return Error{Code::cancelled, "the stop token ended the query"};
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
  module.def("find_impacts", &impacts_of);
  module.def("collision_free_step", &step_of);
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
