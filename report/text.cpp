// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/text.hpp"

#include <fmt/format.h>
#include <utf8.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace impinge::report {
namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr std::string_view kReplacementBytes = "\xEF\xBF\xBD";

/// Whether a character is in one of the ranges whose bounds these are, in order: the first character of each, and the
/// first one after it.
bool is_within(const auto& bounds, char32_t code) {
  return (std::upper_bound(std::begin(bounds), std::end(bounds), code) - std::begin(bounds)) % 2 == 1;
}

/// Controls (C0, DEL, C1), line and paragraph separators, direction marks, the byte order mark, language tags, and
/// U+FFFE and U+FFFF, which are no characters and which XML 1.0 does not allow.
bool steers_a_terminal(char32_t code) {
  static constexpr std::array<char32_t, 21> kSteering{0x00,   0x20,   0x7F,   0xA0,    0x061C,  0x061D,  0x200E,
                                                      0x2010, 0x2028, 0x202F, 0x2066,  0x206A,  0xFEFF,  0xFF00,
                                                      0xFFF9, 0xFFFC, 0xFFFE, 0x10000, 0xE0000, 0xE0080, 0x110000};
  return is_within(kSteering, code);
}

/// Columns of one character. `wcwidth` depends on the locale, and the program never leaves "C".
std::size_t character_columns(char32_t code) {
  static constexpr std::array<char32_t, 32> kCombining{0x0300, 0x0370, 0x0483, 0x048A, 0x0591, 0x05BE, 0x064B, 0x0660,
                                                       0x0900, 0x0903, 0x093C, 0x093D, 0x0941, 0x0949, 0x094D, 0x094E,
                                                       0x0E31, 0x0E32, 0x0E34, 0x0E3B, 0x0E47, 0x0E4F, 0x1AB0, 0x1B00,
                                                       0x200B, 0x200E, 0x20D0, 0x2100, 0xFE00, 0xFE10, 0xFE20, 0xFE30};
  static constexpr std::array<char32_t, 24> kWide{0x1100, 0x1160, 0x2E80,  0x303F,  0x3041,  0xA4D0,  0xA960,  0xA980,
                                                  0xAC00, 0xD7A4, 0xF900,  0xFB00,  0xFE30,  0xFE70,  0xFF00,  0xFF61,
                                                  0xFFE0, 0xFFE7, 0x1F300, 0x1F650, 0x1F900, 0x1FA00, 0x20000, 0x3FFFE};
  if (code < 0x300) return 1;
  if (is_within(kCombining, code)) return 0;
  return is_within(kWide, code) ? 2 : 1;
}

/// Whether the text begins like a byte that is spelled out.
bool spells_a_byte(std::string_view text) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() >= 4 && text.starts_with("\\x") && is_digit(text[2]) && is_digit(text[3]);
}

char32_t folded(char32_t code) { return code >= 'A' && code <= 'Z' ? code + 32 : code; }

std::vector<char32_t> characters(std::string_view text, std::size_t most) {
  std::vector<char32_t> codes;
  for (std::size_t at = 0; at < text.size() && codes.size() < most;) {
    const Character character = decode(text, at);
    codes.push_back(character.code);
    at += character.length;
  }
  return codes;
}

}  // namespace

Character decode(std::string_view text, std::size_t at) {
  constexpr std::size_t kLongest = 4;  // bytes of one character
  const std::string_view rest = text.substr(at, kLongest);
  const char* const begin = rest.data();
  if (utf8::find_invalid(begin, begin + rest.size()) == begin) return {kReplacement, 1, false};
  const char* next = begin;
  const char32_t code = utf8::unchecked::next(next);
  return {code, static_cast<std::size_t>(next - begin), true};
}

std::string distinct_utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    if (character.valid && !spells_a_byte(text.substr(at)))
      result += text.substr(at, character.length);
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    at += character.length;
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    const auto code = static_cast<std::uint32_t>(character.code);
    if (!character.valid) {
      result += kReplacementBytes;
    } else if (code == '\n') {
      result += "\\n";
    } else if (code == '\t') {
      result += "\\t";
    } else if (code == '\r') {
      result += "\\r";
    } else if (steers_a_terminal(character.code)) {
      result += code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
    } else {
      result += text.substr(at, character.length);
    }
    at += character.length;
  }
  return result;
}

std::size_t columns(std::string_view text) {
  std::size_t total = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    total += character_columns(character.code);
    at += character.length;
  }
  return total;
}

std::string fit(std::string_view text, std::size_t width) {
  if (text.size() <= width || columns(text) <= width) return std::string(text);
  if (width == 0) return {};
  // A little more of the head than of the tail: "Cylinder_left_upper_0012" stays "Cylinder_…_0012".
  const std::size_t tail_columns = (width - 1) * 2 / 5;
  const std::size_t head_columns = width - 1 - tail_columns;

  std::size_t head = 0;
  for (std::size_t used = 0; head < text.size();) {
    const Character character = decode(text, head);
    used += character_columns(character.code);
    if (used > head_columns) break;
    head += character.length;
  }
  // The tail begins at the first character from which no more than its columns are left, never at a combining mark.
  std::size_t left = columns(text);
  std::size_t tail = 0;
  while (tail < text.size()) {
    const Character character = decode(text, tail);
    if (left <= tail_columns && character_columns(character.code) > 0) break;
    left -= character_columns(character.code);
    tail += character.length;
  }
  return fmt::format("{}…{}", text.substr(0, head), text.substr(tail));
}

bool matches_pattern(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0;
  // Where to go on from when the characters after the last `*` do not fit: give that `*` one character more.
  std::size_t star = std::string_view::npos, star_text = 0;
  while (t < text.size()) {
    const Character character = decode(text, t);
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_text = t;
    } else if (p < pattern.size() && pattern[p] == '?') {
      ++p;
      t += character.length;
    } else if (p < pattern.size() && pattern.substr(p).starts_with(text.substr(t, character.length))) {
      p += character.length;
      t += character.length;
    } else if (star != std::string_view::npos) {
      star_text += decode(text, star_text).length;
      t = star_text;
      p = star + 1;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t kMost = 200;
  const std::vector<char32_t> from = characters(a, kMost), to = characters(b, kMost);
  const auto same = [&](std::size_t i, std::size_t j) { return folded(from[i]) == folded(to[j]); };
  // Rows of the table of Wagner and Fischer: for the characters before i and j, and one row further back for swaps.
  std::vector<std::size_t> row(to.size() + 1), above(row.size()), before(row.size());
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < from.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      row[j + 1] = std::min({above[j] + (same(i, j) ? 0 : 1), above[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j)) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

std::string grouped(std::uint64_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

std::string counted(std::uint64_t number, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(number), noun, number == 1 ? "" : "s");
}

std::string duration(double seconds) {
  if (!(seconds > 0)) return "0 s";
  if (seconds < 999.5e-9) return fmt::format("{:.3g} ns", seconds * 1e9);
  if (seconds < 999.5e-6) return fmt::format("{:.3g} µs", seconds * 1e6);
  if (seconds < 999.5e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 9.995) return fmt::format("{:.2f} s", seconds);
  if (seconds < 119.95) return fmt::format("{:.1f} s", seconds);
  if (!(seconds < 1e15)) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
  return fmt::format("{} min {} s", grouped(whole / 60), whole % 60);
}

}  // namespace impinge::report
