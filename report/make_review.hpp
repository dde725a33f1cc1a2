// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "report/decisions.hpp"
#include "report/named_tests/configuration.hpp"
#include "report/review.hpp"

namespace impinge::report {

/// What a review needs beside the assembly.
struct ReviewInput {
  ReportOptions options;  ///< with the files, scales and clearance that the configuration adds
  std::optional<Configuration> configuration;
  std::optional<Previous> previous;
  Decisions decisions;
};

/// Reads the configuration, the earlier report and the decisions, if the options name them. Errors: those of
/// `read_configuration`, `add_files`, `read_previous` and `read_decisions`; `bad_option` (a length that is given by an
/// option and by the configuration).
Result<ReviewInput> read_input(const ReportOptions& options);

/// Finds what clashes and compares it with the earlier report. Errors: `bad_file` (a test that names no part), those of
/// `scene_of` and `find_clashes`. `known`: clashes of the assembly's objects, which are then not looked for.
Result<Review> make_review(Assembly assembly, ReviewInput input, std::optional<Clashes> known = std::nullopt);

}  // namespace impinge::report
