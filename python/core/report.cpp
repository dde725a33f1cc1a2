// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Reports of what find_clashes found in a scene: the documents of the command line.
#include "impinge/report.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"
#include "python/core/scene.hpp"

namespace impinge::python {
namespace {

/// A scene as it was when clashes were found in it, which it shares until that changes, and how they were. Documents
/// tell regions of contact, so the first one that is written judges anew, with them, and the next ones take that
/// answer.
struct Judged {
  std::shared_ptr<const Scene> scene;
  report::ReportOptions options;
  std::optional<Clashes> with_regions{};
  Exclusive mutex{};
};

using Named = std::vector<std::tuple<std::uint32_t, std::string, Mesh>>;  ///< index in the scene, name, mesh

/// The scene's objects for a report, in the order given.
Result<report::Assembly> assembly_of(const Judged& judged, const std::string& title, const Named& named) {
  std::vector<io::Model> models(1);
  for (const auto& [index, name, mesh] : named) {
    const Result<ObjectId> id = judged.scene->id(index);
    if (!id) return id.error();
    const Result<Pose> pose = judged.scene->pose(*id);
    if (!pose) return pose.error();
    models[0].objects.push_back({.name = name, .path = name, .product = {}, .mesh = mesh, .pose = *pose});
  }
  return report::assemble({title}, std::move(models));
}

/// What clashes, by the objects' places in `named`.
Result<Clashes> clashes_of(Judged& judged, const Named& named, const std::stop_token& stop) {
  if (!judged.with_regions) {
    Result<Clashes> found = find_clashes(
        *judged.scene,
        {.tolerance = judged.options.tolerance ? std::optional(judged.options.tolerance->value) : std::nullopt,
         .clearance = judged.options.clearance.value,
         .depth_precision = judged.options.depth_precision,
         .regions = true,
         .stop = stop});
    if (!found) return found;
    judged.with_regions = *std::move(found);
  }
  Clashes clashes = *judged.with_regions;
  clashes.parts.clear();
  std::unordered_map<std::uint32_t, std::uint32_t> place_of;
  for (const auto& [index, name, mesh] : named) {
    place_of.emplace(index, static_cast<std::uint32_t>(place_of.size()));
    clashes.parts.push_back(judged.with_regions->parts.at(index));
  }
  for (Clash& pair : clashes.pairs)
    for (std::uint32_t& object : pair.objects) object = place_of.at(object);
  return clashes;
}

Result<void> write(Judged& judged, const Named& named, const std::string& title, const std::string& format,
                   const std::string& file, const std::stop_token& stop) {
  Result<report::Assembly> assembly = assembly_of(judged, title, named);
  if (!assembly) return assembly.error();
  Result<Clashes> clashes = clashes_of(judged, named, stop);
  if (!clashes) return clashes.error();
  judged.options.stop = stop;
  const Result<report::Report> found = report::review(*std::move(assembly), *std::move(clashes), judged.options);
  if (!found) return found.error();
  if (format == "html") return report::write_page(*found, file);
  if (format == "json") return report::write_json(*found, file);
  if (format == "csv") return report::write_csv(*found, file);
  if (format == "bcf") return report::write_bcf(*found, file);
  return report::write_gltf(*found, file);
}

void write_report(Judged& judged, const Named& named, const std::string& title, std::optional<double> unit_in_metres,
                  std::optional<bool> y_up, const std::string& page_program, const std::string& date,
                  const std::string& format, const std::string& file, const Stop* stop) {
  judged.mutex.check("Clashes");
  unwrap(run(stop, kMayTakeLong, [&](std::stop_token token) {
    const std::lock_guard lock(judged.mutex);
    judged.options.unit_in_metres = unit_in_metres;
    judged.options.y_up = y_up;
    judged.options.page_program = page_program;
    judged.options.date = date;
    return write(judged, named, title, format, file, token);
  }));
}

}  // namespace

void bind_reports(py::module_& module) {
  py::class_<Judged>(module, "Judged")
      .def(py::init(
          [](const SharedScene& shared, std::optional<double> tolerance, double clearance, double depth_precision) {
            report::ReportOptions options;
            if (tolerance) options.tolerance = *tolerance;
            options.clearance = clearance;
            options.depth_precision = depth_precision;
            options.regions = true;
            return std::unique_ptr<Judged>(new Judged{shared.scene, std::move(options)});
          }));
  module.def("write_report", &write_report);
}

}  // namespace impinge::python
