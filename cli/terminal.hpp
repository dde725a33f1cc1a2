// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace impinge::cli {

/// "impinge: " and the sentence, on one line of standard error, safe for a terminal.
void complain(std::string_view sentence);

/// How wide the lines of this descriptor are: the terminal's width, or the variable COLUMNS; nothing if neither says.
std::optional<std::size_t> width_of(int descriptor);

/// Opens the null device on standard descriptors that the caller closed, so that no file read or written lands on
/// them; writing to a closed standard output stays an error.
void fill_closed_descriptors();

}  // namespace impinge::cli
