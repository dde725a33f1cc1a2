// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "report/json_writer.hpp"
#include "report/review.hpp"

/// What triage adds to the JSON of `clash`; each of the writers writes a member of the document.
namespace impinge::report {

void write_tests(JsonDocument& document, const Review& review);
void write_types(JsonDocument& document, const Review& review);
void write_resolved(JsonDocument& document, const Review& review);
void write_groups(JsonDocument& document, const Review& review, GroupBy by);

/// Members of a pair: "test", "change", "status", "comment" and "was".
Json json_triage(const Review& review, std::size_t pair);

/// "new", "persisting" or null.
Json json_change(Change change);

}  // namespace impinge::report
