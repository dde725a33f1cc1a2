// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

/// Text for people: names from files made safe to print, cut to a width, and numbers written the same in every locale.
namespace impinge::report {

/// One character of a text that may not be UTF-8.
struct Character {
  char32_t code = 0;       ///< U+FFFD where the bytes are not UTF-8
  std::size_t length = 1;  ///< in bytes; 1 where they are not UTF-8
  bool valid = true;
};

/// The character that begins at byte `at`, which must be inside the text.
Character decode(std::string_view text, std::size_t at);

/// The text as UTF-8 that no other text becomes: every byte that is part of no character is spelled out (`\xff`), and
/// so is a backslash before what looks like that (`\x5c`).
std::string distinct_utf8(std::string_view text);

/// The text as one line that cannot steer a terminal: bytes that are part of no character become U+FFFD;
/// control characters, line separators and marks that turn the writing direction are spelled out (`\n`, `\x1b`,
/// `\u202e`).
std::string printable(std::string_view text);

/// How many columns of a terminal a printable text takes: wide characters two, combining marks none.
std::size_t columns(std::string_view text);

/// A printable text cut to so many columns with `…` in the middle, where names of parts differ least.
std::string fit(std::string_view text, std::size_t width);

/// Whether `text` is what the shell pattern says: `*` stands for any characters, `?` for one.
bool matches_pattern(std::string_view pattern, std::string_view text);

/// How many characters must be typed, deleted, replaced or swapped with their neighbour to turn one text into the
/// other; case costs nothing. Texts are compared in their first 200 characters.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first of the texts that are spelled most like the word, empty where all are empty. Of many the first 100,000 are
/// looked at: enough to find a typing error without making anybody wait. `text_of` gives an element's text, which
/// stays.
template <class Texts, class TextOf = std::identity>
std::string nearest_text(std::string_view word, const Texts& texts, TextOf text_of = {}) {
  std::size_t left = 100'000, least = std::string::npos;
  std::string_view nearest;
  for (const auto& each : texts) {
    if (left-- == 0) break;
    const std::string_view text = std::invoke(text_of, each);
    const std::size_t distance = text.empty() ? least : edit_distance(word, text);
    if (distance < least) least = distance, nearest = text;
  }
  return std::string(nearest);
}

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// A count and its noun: "1 object", "2,000 objects".
std::string counted(std::uint64_t number, std::string_view noun);

/// A time as a person says it: "85 ns", "3.2 ms", "1.24 s", "3 min 20 s".
std::string duration(double seconds);

}  // namespace impinge::report
