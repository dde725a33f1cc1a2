// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Verdicts, regions of contact, what parts are, and files. Structs become tuples of their members in order.
#include "impinge/clash.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>
#include <optional>
#include <string>

#include "impinge/io.hpp"
#include "impinge/regions.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"
#include "python/core/scene.hpp"

namespace impinge::python {
namespace {

/// What one query after the other uses.
struct SharedMemory {
  ClashMemory memory;
  Exclusive mutex;
};

Array points_of(std::vector<Point> points) {
  const auto count = static_cast<py::ssize_t>(points.size());
  return array_of(std::move(points), "d", 8, {count, 3});
}

Array indices_of(std::vector<std::uint32_t> indices) {
  const auto count = static_cast<py::ssize_t>(indices.size());
  return array_of(std::move(indices), "i", 4, {count});
}

py::tuple to_python(const Point& point) { return py::make_tuple(point.x, point.y, point.z); }

py::tuple to_python(Region& region) {
  py::list lines;
  for (auto& line : region.lines) lines.append(points_of(std::move(line)));
  return py::make_tuple(region.pairs, points_of({region.box[0], region.box[1]}), region.area, region.length,
                        to_python(region.centroid), to_python(region.normal), lines,
                        indices_of(std::move(region.triangles_a)), indices_of(std::move(region.triangles_b)));
}

py::list to_python(std::vector<Region>& regions) {
  py::list all;
  for (Region& region : regions) all.append(to_python(region));
  return all;
}

py::tuple to_python(Clash& clash) {
  const py::object nearest = clash.nearest ? nearest_tuple(*clash.nearest) : py::none();
  py::object depth = py::none();
  if (const auto& found = clash.overlap_depth)
    depth = py::make_tuple(found->a_in_b.lo, found->a_in_b.hi, found->b_in_a.lo, found->b_in_a.hi);
  py::object volume = py::none();
  if (const auto& found = clash.overlap_volume) volume = py::make_tuple(found->volume, found->error);
  return py::make_tuple(clash.objects, static_cast<int>(clash.verdict), clash.inner, std::string(sentence(clash.note)),
                        clash.tolerance, clash.fails_below, clash.contacts, nearest, depth, volume,
                        to_python(clash.regions));
}

py::tuple to_python(const PartFacts& facts) {
  return py::make_tuple(static_cast<int>(facts.part_class), facts.closed, facts.pieces, facts.turned,
                        facts.unclear_edges, facts.open_edges, facts.self_crossings, facts.degenerate, facts.volume,
                        facts.area, facts.radius);
}

/// What the verdicts are asked with, in the order of the Python signature.
struct VerdictOptions {
  std::optional<double> tolerance;
  double clearance, depth_precision;
  bool regions, volumes;
  int threads;

  [[nodiscard]] ClashOptions with(std::stop_token stop) const {
    return {.tolerance = tolerance,
            .clearance = clearance,
            .depth_precision = depth_precision,
            .regions = regions,
            .volumes = volumes,
            .threads = threads,
            .stop = std::move(stop)};
  }
};

py::tuple find_in_scene(SharedScene& shared, const VerdictOptions& options, SharedMemory* memory, const Stop* stop) {
  if (memory != nullptr) memory->mutex.check("ClashMemory");
  Clashes found = unwrap(run(stop, shared.triangles, [&](std::stop_token token) {
    std::unique_lock<Exclusive> lock;
    if (memory != nullptr) lock = std::unique_lock(memory->mutex);
    return find_clashes(*shared.scene, options.with(token), memory != nullptr ? &memory->memory : nullptr);
  }));
  py::list pairs, parts;
  for (Clash& clash : found.pairs) pairs.append(to_python(clash));
  for (const PartFacts& facts : found.parts) parts.append(to_python(facts));
  return py::make_tuple(pairs, parts);
}

py::tuple judge_pair(const Pair& p, const VerdictOptions& options, const Stop* stop) {
  Clash found =
      run_pair(p, stop, [&](std::stop_token token) { return judge(p.a, p.at, p.b, p.bt, options.with(token)); });
  return to_python(found);
}

py::tuple examine_mesh(const Mesh& mesh, py::handle pose, const VerdictOptions& options, const Stop* stop) {
  const Pose at = pose_of(pose, "pose");
  return to_python(unwrap(
      run(stop, mesh.triangle_count(), [&](std::stop_token token) { return examine(mesh, at, options.with(token)); })));
}

py::list regions_of_pair(const Pair& p, double tolerance, int threads, const Stop* stop) {
  auto found = run_pair(p, stop, [&](std::stop_token token) {
    return contact_regions(p.a, p.at, p.b, p.bt, {.tolerance = tolerance, .threads = threads, .stop = token});
  });
  return to_python(found);
}

py::tuple read_file(const std::string& file, double scale, std::optional<double> unit_in_metres,
                    const std::string& importer, const Stop* stop) {
  io::Model model = unwrap(run(stop, kMayTakeLong, [&](std::stop_token token) {
    io::ReadOptions options;
    options.scale = scale;
    options.unit_in_metres = unit_in_metres;
    options.importer = importer;
    options.stop = token;
    return io::read(file, options);
  }));
  py::list objects;
  for (io::Object& object : model.objects)
    objects.append(py::make_tuple(object.name, object.path, std::move(object.mesh), matrix_of(object.pose),
                                  object.properties, object.incomplete));
  return py::make_tuple(objects, model.unit_in_metres, model.missing, model.warnings);
}

}  // namespace

void bind_clashes(py::module_& module) {
  py::class_<SharedMemory>(module, "ClashMemory",
                           "What one call of find_clashes found out, for the next one on the same scene.")
      .def(py::init<>())
      .def("known_pairs", [](SharedMemory& memory) {
        memory.mutex.check("ClashMemory");
        const Unlocked released;
        const std::lock_guard lock(memory.mutex);
        return memory.memory.known_pairs();
      });
  py::class_<VerdictOptions>(module, "VerdictOptions")
      .def(py::init([](std::optional<double> tolerance, double clearance, double depth_precision, bool regions,
                       bool volumes, int threads) {
        return VerdictOptions{tolerance, clearance, depth_precision, regions, volumes, threads};
      }));
  module.def("find_clashes", &find_in_scene);
  bind_pair(module, "judge", &judge_pair);
  module.def("examine", &examine_mesh);
  bind_pair(module, "contact_regions", &regions_of_pair);
  module.def("read", &read_file);
}

}  // namespace impinge::python
