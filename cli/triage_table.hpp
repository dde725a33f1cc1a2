// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "report/review.hpp"
#include "report/sink.hpp"

/// What `impinge clash` prints about groups of pairs, named tests and changes since an earlier run.
namespace impinge::cli {

/// A row for each group, the one with the worst pair first. `shown` is how many rows there are at most.
void print_groups(const Review& review, GroupBy by, const std::vector<std::size_t>& order, std::uint64_t shown,
                  Sink& sink, std::optional<std::size_t> width, const std::stop_token& stop);

/// A line for each test, and one on what changed since the previous run; nothing where there are none.
std::string triage_summary(const Review& review, const ClashArguments& arguments);

}  // namespace impinge::cli
