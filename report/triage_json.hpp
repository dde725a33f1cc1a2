// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "report/review.hpp"
#include "report/sink.hpp"

/// What triage adds to the JSON of `clash`; each of the writers writes a member of the document and the comma after it.
namespace impinge::report {

void write_tests(Sink& sink, const Review& review);
void write_types(Sink& sink, const Review& review);
void write_resolved(Sink& sink, const Review& review);
void write_groups(Sink& sink, const Review& review, GroupBy by);

/// Members of a pair, without braces: "test", "change", "status", "comment", "was" and "ambiguous".
std::string json_triage(const Review& review, std::size_t pair);

/// Members of an object, without braces: "change", "status" and "comment".
std::string json_standing(Change change, const Remark& remark);

}  // namespace impinge::report
