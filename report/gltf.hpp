// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "report/review.hpp"
#include "report/sink.hpp"

namespace impinge::report {

/// The places of the clashes as binary glTF 2.0, worst first: a node for each pair, and in it one for each region of
/// contact, with its lines and centroid, and one for the nearest points (docs/reports.md). Errors: `bad_file` where
/// that would be more than 4 GB; `cancelled`.
Result<void> write_gltf(Sink& sink, const Review& review, const ReportOptions& options, const std::stop_token& stop);

}  // namespace impinge::report
