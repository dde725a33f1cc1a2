// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string_view>

namespace impinge::scenes {

/// Whether the whole argument of a program is a number that fits; then it is the value.
template <class Whole>
bool parse_whole(std::string_view argument, Whole& value) {
  const auto [end, error] = std::from_chars(argument.data(), argument.data() + argument.size(), value);
  return error == std::errc{} && end == argument.data() + argument.size();
}

}  // namespace impinge::scenes
