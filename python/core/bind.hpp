// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "impinge/contacts.hpp"
#include "impinge/measures.hpp"
#include "impinge/options.hpp"

/// The parts of the module impinge._core. Arguments are positional and were checked by the Python above; its stub,
/// _core.pyi, says what they are.
namespace impinge::python {

void bind_meshes(pybind11::module_& module);
void bind_scenes(pybind11::module_& module);
void bind_clashes(pybind11::module_& module);
void bind_motion(pybind11::module_& module);
void bind_reports(pybind11::module_& module);

/// `Options` as Python hands them over: (first, limit, kinds, threads, backend, device, by_index); the strings live as
/// long as this.
struct QueryOptions {
  QueryOptions(bool first, std::uint64_t limit, std::uint8_t kinds, int threads, std::string backend,
               std::string device, bool by_index);
  [[nodiscard]] Options with(std::stop_token stop) const;

  bool first;
  std::uint64_t limit;
  std::uint8_t kinds;
  int threads;
  std::string backend, device;
  bool by_index;
};

/// `MeasureOptions` likewise: (stop_above, enough_below, threads).
struct DistanceOptions {
  double stop_above, enough_below;
  int threads;

  [[nodiscard]] MeasureOptions with(std::stop_token stop) const {
    return {.threads = threads, .stop = std::move(stop), .stop_above = stop_above, .enough_below = enough_below};
  }
};

/// (objects, offsets, pairs, kinds, truncated, hash, warnings).
pybind11::tuple contacts_tuple(Contacts&& contacts);
/// (distance, error, points, (triangle, triangle)); None where the distance is infinite.
pybind11::object nearest_tuple(const Nearest& nearest);

}  // namespace impinge::python
