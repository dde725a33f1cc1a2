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

/// Short enough for a column, where the JSON has the sentence; a dash for none.
std::string note_text(Note note);

}  // namespace impinge::cli
