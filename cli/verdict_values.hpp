// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_options.hpp"

/// Values that say what is a clash, which of them fail and how they are sorted out. Errors: `bad_option`.
namespace impinge::cli {

Result<void> take_tolerance(const std::string& text, std::optional<double>& to);
/// The tolerance and the clearance.
Result<void> take_lengths(const Raw& raw, ClashArguments& to);
/// The configuration, the earlier run and the groups of the table.
Result<void> take_triage(const Raw& raw, ClashArguments& to);
/// The words of `--fail-on`, of which none is set if none is given.
Result<void> take_words(const std::vector<std::string>& lists, FailOn& to);
/// The same, and whether they go together with the other options.
Result<void> take_fail_on(const std::vector<std::string>& lists, ClashArguments& to);

}  // namespace impinge::cli
