// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// The oracle's answers, kept in answers.txt since CGAL takes minutes to compile and to run. A line is a key, the hash
/// of the question's bytes, so that a question that changes is no longer found there; the answer's words; and the test
/// that asks. Environment: IMPINGE_ANSWERS_OUT=FILE reads none and writes each that the oracle computes to the file's
/// end.
namespace impinge::expected {

/// The answer under this key. Fails the running test where there is none.
std::string kept_answer(const std::string& key);
/// What the oracle has just computed: fails the running test where something else is kept, or nothing.
void hold_to_kept(const std::string& key, const std::string& answer);

}  // namespace impinge::expected
