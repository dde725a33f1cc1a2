// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>

#include "report/review.hpp"
#include "report/sink.hpp"

namespace impinge::cli {

/// The ranked table, the parts that are no solids, and the summary.
void print_review(const Review& review, const ClashArguments& arguments, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop);

/// A note in a few words for a column of a table; a dash for none. The JSON has a sentence instead.
std::string note_text(Note note);

}  // namespace impinge::cli
