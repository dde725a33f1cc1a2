// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <stop_token>

#include "arguments.hpp"
#include "impinge/options.hpp"
#include "progress.hpp"
#include "report/assembly.hpp"
#include "report/scene.hpp"

/// What `check` and `clash` do alike.
namespace impinge::cli {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// Reads the files while a line shows how far that is. Errors: as the library's `read_assembly`.
Result<Assembly> read_assembly(const SceneOptions& options, ProgressLine& line, const std::stop_token& stop);

/// How much of the work is done, for a progress line.
Work work_of(const Progress& progress);

/// Says on standard error what of the files no answer is about; also where everything else is quiet, for nothing that
/// is found may mean nothing then.
void mention_missing(const Assembly& assembly);
/// Says on standard error how the files were aligned, and that they have warnings, if they have.
void mention_warnings(const Assembly& assembly);

}  // namespace impinge::cli
