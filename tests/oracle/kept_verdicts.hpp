// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "scenes/solid_pairs.hpp"

/// The oracle's verdicts on the pairs of scenes/solid_pairs.hpp, kept in verdicts.txt since Nef polyhedra take minutes.
/// Each is filed under the hash of the pair's bytes, so that a pair that changes is no longer found there. A few, drawn
/// by a seed that is printed, are computed anew all the same, and held against what is kept.
///
/// Environment: IMPINGE_VERDICTS_ANEW=all computes every one anew, IMPINGE_VERDICTS_ANEW=N draws with the seed N, and
/// IMPINGE_VERDICTS_OUT=FILE reads none and writes each that is asked for to the file's end.
namespace impinge::expected {

/// Nothing for a pair that is not there.
std::optional<scenes::Judgement> kept_verdict(const std::string& key);
/// Whether the one under this key was drawn.
bool is_computed_anew(const std::string& key);
/// Where IMPINGE_VERDICTS_OUT asks for it.
void write_down(const std::string& key, const std::string& name, const scenes::Judgement& judgement);

}  // namespace impinge::expected
