// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tbb/global_control.h>

#include <memory>

#include "impinge/devices.hpp"
#include "impinge/version.hpp"
#include "python/core/array.hpp"
#include "python/core/bind.hpp"
#include "python/core/query.hpp"

namespace impinge::python {
namespace {

py::list devices_of_machine() {
  const auto found = unwrap([] {
    const Unlocked released;
    return devices();
  }());
  py::list all;
  for (const DeviceInfo& device : found) {
    all.append(py::make_tuple(device.name, device.driver, static_cast<int>(device.type), device.memory_bytes,
                              device.is_certified, device.complaint));
  }
  return all;
}

/// 0: as many as oneTBB offers.
void set_num_threads(std::size_t threads) {
  // Never destroyed: at the program's end TBB may be gone before it.
  static auto& limit = *new std::unique_ptr<tbb::global_control>;
  limit.reset();
  if (threads > 0) limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  py::options options;
  options.disable_function_signatures();
  module.doc() = "The library, for the Python of the package impinge alone.";
  module.attr("VERSION") = IMPINGE_VERSION;

  py::class_<Array>(module, "_Array", py::buffer_protocol()).def_buffer([](Array& array) {
    static char nothing = 0;  // the address of an empty array
    std::vector<py::ssize_t> strides(array.shape.size());
    py::ssize_t stride = array.itemsize;
    for (std::size_t i = strides.size(); i-- > 0;) {
      strides[i] = stride;
      stride *= array.shape[i];
    }
    return py::buffer_info(array.data != nullptr ? array.data : &nothing, array.itemsize, array.format,
                           static_cast<py::ssize_t>(array.shape.size()), array.shape, strides, array.readonly);
  });
  py::class_<Stop>(module, "Stop", "Ends the queries that are given it; safe to use from every thread.")
      .def(py::init<>())
      .def(
          "set", [](Stop& stop) { stop.source.request_stop(); }, "Ends them, those still to come too.")
      .def(
          "is_set", [](const Stop& stop) { return stop.source.stop_requested(); }, "Whether `set` was called.");
  bind_meshes(module);
  bind_scenes(module);
  bind_clashes(module);
  bind_motion(module);
  bind_reports(module);
  module.def("devices", &devices_of_machine);
  module.def("set_num_threads", &set_num_threads);
}

}  // namespace impinge::python
