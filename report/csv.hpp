// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <string>
#include <string_view>

#include "report/review.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// After a row of names a row for each pair, worst first, and for what is gone: RFC 4180, UTF-8 (docs/reports.md).
/// Errors: `cancelled`.
Result<void> write_csv(Sink& sink, const Review& review, const ReportOptions& options, const std::stop_token& stop);

/// A text as a cell: one printable line, which no spreadsheet takes for a formula, in quotes where it needs them.
std::string csv_cell(std::string_view text);

}  // namespace impinge::report
