// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "impinge/result.hpp"

/// Text: sentences that are put together, numbers that are read, and the line that a reader stands in.
namespace impinge::io {

inline void append_to(std::string& out, std::string_view text) { out += text; }
template <std::integral T>
void append_to(std::string& out, T number) {
  out += std::to_string(number);
}
template <std::floating_point T>
void append_to(std::string& out, T number) {
  char digits[40];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr);
}

/// One sentence of its parts: texts and numbers.
template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::string out;
  (append_to(out, parts), ...);
  return out;
}

/// A word of the file as it may stand in a message: printable, and cut after 40 characters.
std::string in_quotes(std::string_view word);

/// What a file is called: `label` in messages, `name` where an object has no name of its own.
struct Source {
  std::string_view label, name;
};

Error file_error(const Source& source, std::string_view message);
Error line_error(const Source& source, std::uint64_t line, std::string_view message);
Error byte_error(const Source& source, std::uint64_t byte, std::string_view message);

/// Refuses bytes that are no text: those with a NUL among the first 4096; later ones are blanks. Errors: `bad_file`.
Result<void> check_text(std::string_view bytes, const Source& source);

/// The nearest double to a decimal number, with or without a leading '+'. Anything else, NaN, infinity and numbers
/// outside the range of a double leave a sentence part in `problem`; numbers that underflow are rounded like others.
bool parse_real(std::string_view word, double& value, std::string& problem);
bool parse_integer(std::string_view word, std::int64_t& value, std::string& problem);

/// A reader whose functions return false where something is wrong with the file.
class FailingReader {
 protected:
  bool fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  std::string problem_;  ///< part of a sentence
};

/// Walks over a text word by word or line by line. Lines end with LF, CR LF or CR.
class Scanner {
 public:
  /// `comment` starts a comment up to the line's end where a word could start; 0 for none.
  explicit Scanner(std::string_view bytes, char comment = 0) : rest_(bytes), comment_(comment) {}

  /// The next word, or an empty one at the end.
  std::string_view word();
  /// The rest of the line, without its end; the scanner then stands on the next line.
  std::string_view rest_of_line();
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }
  /// Of the word or line that was handed out last.
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  void take_line_end();
  void skip_blank();

  std::string_view rest_;
  std::uint64_t next_line_ = 1;
  std::uint64_t line_ = 1;
  char comment_;
};

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace impinge::io
