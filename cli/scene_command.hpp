// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "arguments.hpp"
#include "impinge/options.hpp"
#include "impinge/scene.hpp"
#include "pace.hpp"
#include "report/assembly.hpp"
#include "report/sink.hpp"

/// What `check` and `clash` do alike.
namespace impinge::cli {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// The assembly as a scene that knows which of its objects are near each other; an object's index is its number.
/// Objects of one group that is not 0 are not tested against each other; without groups, none. Errors: `bad_option` of
/// `--ignore`; `bad_pose`, with the object's name.
Result<Scene> scene_of(const Assembly& assembly, const SceneArguments& arguments,
                       std::span<const std::uint32_t> groups = {});

/// How much of the work is done, for a progress line.
Work work_of(const Progress& progress);

/// Says on standard error what of the files no answer is about; also where everything else is quiet, for nothing that
/// is found may mean nothing then.
void mention_missing(const Assembly& assembly);
/// Says on standard error that the files have warnings, if they have.
void mention_warnings(const Assembly& assembly);

}  // namespace impinge::cli
