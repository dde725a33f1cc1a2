// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "report/review.hpp"
#include "report/sink.hpp"

/// The documents that tell of a review. Regions and distances are written where its options ask for them.
/// Errors: `cancelled`, by the `stop` of its options. Write errors stay in the sink.
namespace impinge::report {

/// The document of `clash --json`: no times, so that the same files and settings give the same bytes.
Result<void> write_clash_json(Sink& sink, const Review& review);

/// The same document of an assembly of which nothing was asked: settings and counts are null, and no pairs.
Result<void> write_view_json(Sink& sink, const Assembly& assembly);

/// After a row of names a row for each pair, worst first, and for what is gone: RFC 4180, UTF-8 (docs/reports.md).
Result<void> write_csv(Sink& sink, const Review& review);

/// How many pairs there are, and how many fail, between each two files, IFC classes and storeys: a row for each two
/// that have any, as long as there are several.
Result<void> write_matrix(Sink& sink, const Review& review);

/// A text as a cell: one printable line, which no spreadsheet takes for a formula, in quotes where it needs them.
std::string csv_cell(std::string_view text);
/// The text of a cell, out of its quotes, without the apostrophe that kept it from being a formula.
std::string without_defusing(std::string_view cell);

/// The places of the clashes as binary glTF 2.0, worst first: a node for each pair, and in it one for each region of
/// contact, with its lines and centroid, and one for the nearest points (docs/reports.md). Errors: also `bad_file`,
/// where that would be more than 4 GB.
Result<void> write_gltf(Sink& sink, const Review& review);

/// The pairs that become topics of the BCF, worst first: those that fail, as many as `--bcf-topics` allows.
struct Topics {
  std::vector<std::size_t> pairs;
  std::size_t left_out = 0;  ///< by the limit
};
Topics topics_of(const Review& review);

/// BCF (buildingSMART), of the version that the options say: a zip archive with a folder for each topic. `done` is
/// called after each. Errors: as `write_zip`.
Result<void> write_bcf(Sink& sink, const Review& review, const Topics& topics, const std::function<void()>& done);

}  // namespace impinge::report
