// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

/// Numbers on the command line: the whole text must be the number, in every locale.
namespace impinge::cli {

/// Decimal digits alone, below 2^64.
std::optional<std::uint64_t> parse_whole(std::string_view text);

/// A size in bytes: digits, and K, M, G or T for powers of 1000, small or capital, with or without a B: "500M", "2GB".
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// A positive finite number: "0.001", "1e-3", "25.4".
std::optional<double> parse_positive(std::string_view text);

/// The same, or 0.
std::optional<double> parse_length(std::string_view text);

}  // namespace impinge::cli
