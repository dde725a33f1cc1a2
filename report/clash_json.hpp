// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "report/review.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// The document of `clash --json`: no times, so that the same files and settings give the same bytes.
/// Errors: `cancelled`. Write errors stay in the sink.
Result<void> write_clash_json(Sink& sink, const Review& review, const ReportOptions& options,
                              const std::stop_token& stop);

/// The same document of an assembly of which nothing was asked: settings and counts are null, and no pairs.
Result<void> write_view_json(Sink& sink, const Assembly& assembly);

}  // namespace impinge::report
