// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "arguments.hpp"
#include "report/part.hpp"
#include "report/review.hpp"
#include "report/sink.hpp"

namespace impinge::cli {

/// A line for each of the first few parts that are no solids, and how many more there are. Labels are printable, and
/// cut where the width of a line is known.
void print_surfaces(std::span<const std::string> labels, std::span<const Part> parts, Sink& sink,
                    std::optional<std::size_t> width);

/// The ranked table, the parts that are no solids, and the summary.
void print_review(const Review& review, const ClashArguments& arguments, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop);

/// A note in a few words for a column of a table; a dash for none. The JSON has a sentence instead.
std::string note_text(Note note);

}  // namespace impinge::cli
