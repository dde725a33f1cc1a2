// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "impinge/result.hpp"

/// Dates in documents, as XML Schema writes them, in UTC: "2024-05-31T16:30:00Z".
namespace impinge::cli {

/// What `--date` says, "now", "2024-05-31" or "2024-05-31T16:30:00Z"; nothing for any other text, and for days that
/// there are none of.
std::optional<std::string> parse_date(std::string_view text);

/// Without `--date`: that of the variable SOURCE_DATE_EPOCH (https://reproducible-builds.org/specs/source-date-epoch),
/// or now. Errors: `bad_option`, of the variable.
Result<std::string> usual_date();

}  // namespace impinge::cli
