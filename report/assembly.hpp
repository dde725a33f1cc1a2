// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "arguments.hpp"
#include "impinge/io.hpp"
#include "progress.hpp"

namespace impinge::report {

/// The objects of all files of a call, numbered over the files in their order.
struct Assembly {
  std::vector<std::string> files;
  std::vector<io::Object> objects;
  std::vector<io::Group> groups;       ///< those of all files, numbered over the files as well
  std::vector<std::uint32_t> file_of;  ///< for each object
  std::vector<std::string> labels;     ///< for each object, what a person is shown; printable
  std::vector<std::string> warnings;
  std::vector<std::string> missing;  ///< of the files, with their names: no answer is about it
  std::uint64_t triangles = 0;
};

/// Reads the files. Errors: those of `io::read`.
Result<Assembly> read_assembly(const SceneArguments& arguments, ProgressLine& progress, const std::stop_token& stop);

/// What a person is shown for each object: its name, made printable, with its file where objects of two files have the
/// same name.
std::vector<std::string> labels_of(const Assembly& assembly);

/// For each object a number that those of the same IFC product of the same file have in common; 0 without a product.
std::vector<std::uint32_t> products_of(const Assembly& assembly);

/// The error that an interrupted command ends with, whatever it was doing.
Error interrupted();

}  // namespace impinge::report
