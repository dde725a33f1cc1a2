// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "impinge/result.hpp"

namespace impinge::report {

/// The bytes of a file, of which there must be no more than so many. Errors: `bad_file`, with the name and the reason.
Result<std::string> read_text_file(const std::string& name, std::uint64_t most_bytes);

}  // namespace impinge::report
