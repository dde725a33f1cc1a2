// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "numbers.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace impinge::cli {
namespace {

template <class T>
std::optional<T> parse_all(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// 1000 to the power that a letter stands for; 0 for any other character.
std::uint64_t unit_bytes(char letter) {
  switch (letter) {
    case 'k':
    case 'K':
      return 1'000;
    case 'm':
    case 'M':
      return 1'000'000;
    case 'g':
    case 'G':
      return 1'000'000'000;
    case 't':
    case 'T':
      return 1'000'000'000'000;
    default:
      return 0;
  }
}

}  // namespace

std::optional<std::uint64_t> parse_whole(std::string_view text) { return parse_all<std::uint64_t>(text); }

std::optional<std::uint64_t> parse_bytes(std::string_view text) {
  if (text.ends_with('B') || text.ends_with('b')) text.remove_suffix(1);
  std::uint64_t unit = 1;
  if (!text.empty() && unit_bytes(text.back()) != 0) {
    unit = unit_bytes(text.back());
    text.remove_suffix(1);
  }
  const auto count = parse_whole(text);
  if (!count || *count > std::numeric_limits<std::uint64_t>::max() / unit) return std::nullopt;
  return *count * unit;
}

std::optional<double> parse_positive(std::string_view text) {
  const auto value = parse_all<double>(text);
  if (!value || !std::isfinite(*value) || !(*value > 0)) return std::nullopt;
  return value;
}

std::optional<double> parse_length(std::string_view text) {
  const auto value = parse_all<double>(text);
  if (!value || !std::isfinite(*value) || !(*value >= 0)) return std::nullopt;
  return *value + 0.0;  // -0 is 0
}

}  // namespace impinge::cli
