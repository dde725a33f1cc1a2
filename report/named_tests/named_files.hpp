// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "impinge/report.hpp"
#include "report/named_tests/configuration.hpp"

namespace impinge::report {

/// Which of the files a word of the configuration names: the one that stands there, from the configuration's folder;
/// or else those whose name, with or without its folders, the word is or describes as a pattern.
std::vector<std::uint32_t> files_named(const Configuration& configuration, const std::string& word,
                                       const std::vector<std::string>& files);

/// Adds to the files to read those that the configuration names and that are not among them, and finds out which files
/// the given scales are for. Errors: `bad_file` (there is no such file); `bad_option` (a scale of no file, or a
/// second).
Result<void> add_files(const Configuration& configuration, ReportOptions& options);

}  // namespace impinge::report
