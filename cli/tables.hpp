// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.hpp"
#include "impinge/contacts.hpp"
#include "report/motion/motion_report.hpp"
#include "report/review.hpp"
#include "report/sink.hpp"

/// What the commands print of their answers.
namespace impinge::cli {

/// A part below a table.
struct NamedPart {
  std::string_view label;
  std::string_view incomplete;  ///< what of its shape the reader left out; empty: nothing
  const Part* part;             ///< null: it is not known what it is
};
/// A line for each of the first few parts that are incomplete, and of those that are no solids, surfaces first; how
/// many more there are, and what surfaces hide. Labels are cut where the width of a line is known. False: there are
/// none.
bool print_parts(std::span<const NamedPart> parts, const std::optional<double>& unit_in_metres, Sink& sink,
                 std::optional<std::size_t> width);

/// The ranked table, the parts that are incomplete or no solids, and the summary.
void print_review(const Review& review, const ClashArguments& arguments, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop);

/// What follows the heading of a column of lengths: " (mm)", or nothing where the unit is not known.
std::string in_unit(const std::optional<double>& metres);

/// How many pairs have each verdict, in the order of verdicts: "3 inside, 12 penetrating". `apart` says what those are
/// that are apart. Empty where there are no pairs.
std::string counts_text(const std::array<std::uint64_t, 6>& counts, std::string_view apart);

/// A note in a few words for a column of a table; a dash for none. The JSON has a sentence instead.
std::string note_text(Note note);

/// A row for each group, the one with the worst pair first. `shown` is how many rows there are at most.
void print_groups(const Review& review, GroupBy by, const std::vector<std::size_t>& order, std::uint64_t shown,
                  Sink& sink, std::optional<std::size_t> width, const std::stop_token& stop);

/// A line for each test, and one on what changed since the previous run; nothing where there are none.
std::string triage_summary(const Review& review, const ClashArguments& arguments);

/// Prints the table of clashes by the time at which they begin, and a summary that names the length of a step.
void print_motion(const MotionReport& report, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop);

/// The tables of `--stats`: what each stage did and how long it took, and the cost function beside the measured time.
void print_statistics(const Statistics& statistics, Sink& sink);

}  // namespace impinge::cli
