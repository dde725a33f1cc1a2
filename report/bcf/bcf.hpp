// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "report/review.hpp"
#include "report/sink.hpp"

/// BCF 2.1 (buildingSMART): a zip archive with a folder for each topic.
namespace impinge::report {

/// The pairs that become topics, worst first: those that `--fail-on` names, as many as `--bcf-topics` allows.
struct Topics {
  std::vector<std::size_t> pairs;
  std::size_t left_out = 0;  ///< by the limit
};
Topics topics_of(const Review& review, const ReportOptions& options);

/// Writes the archive; `done` is called after each topic. Errors: as `write_zip`.
Result<void> write_bcf(Sink& sink, const Review& review, const ReportOptions& options, const Topics& topics,
                       const std::function<void()>& done, const std::stop_token& stop);

}  // namespace impinge::report
