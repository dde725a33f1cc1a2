// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "arguments.hpp"
#include "report/named_tests/configuration.hpp"

namespace impinge::cli {

/// The command line with what its configuration adds to it.
struct ConfiguredClash {
  ClashArguments arguments;
  std::optional<Configuration> configuration;
};

/// Reads the configuration, if there is one. Errors: those of `read_configuration` and `add_files`; `bad_option` (said
/// twice, by an option and for all tests).
Result<ConfiguredClash> configure(const ClashArguments& given);

}  // namespace impinge::cli
