// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/text.hpp"

#include <locale.h>
#include <stdlib.h>

#include <cmath>

namespace impinge::io {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// strtod in the C locale: it rounds numbers that underflow, which from_chars only reports.
double rounded_by_strtod(const std::string& word) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  return c_locale ? strtod_l(word.c_str(), nullptr, c_locale) : strtod(word.c_str(), nullptr);
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string out = "'";
  for (const char c : word.substr(0, kMost)) out += c >= ' ' && c <= '~' ? c : '?';
  return out += word.size() > kMost ? "...'" : "'";
}

Error file_error(const Source& source, std::string_view message) {
  return {Code::bad_file, sentence(source.label, ": ", message)};
}
Error line_error(const Source& source, std::uint64_t line, std::string_view message) {
  return {Code::bad_file, sentence(source.label, ", line ", line, ": ", message)};
}
Error byte_error(const Source& source, std::uint64_t byte, std::string_view message) {
  return {Code::bad_file, sentence(source.label, ", byte ", byte, ": ", message)};
}

Result<void> check_text(std::string_view bytes, const Source& source) {
  const std::size_t nul = bytes.substr(0, 4096).find('\0');
  if (nul == bytes.npos) return {};
  return byte_error(source, nul,
                    "a zero byte stands where text should; the file is damaged, in UTF-16, or of another format");
}

bool parse_real(std::string_view word, double& value, std::string& problem) {
  const std::string_view digits = without_plus(word);
  const char* const end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, value);
  if (code == std::errc::invalid_argument || stop != end) {
    problem = sentence(in_quotes(word), " is not a number");
    return false;
  }
  if (code == std::errc::result_out_of_range) value = rounded_by_strtod(std::string(digits));
  if (std::isfinite(value)) return true;
  const char first = digits[digits[0] == '-' ? 1 : 0];
  const bool is_number = first == '.' || (first >= '0' && first <= '9');
  problem = sentence(in_quotes(word), is_number ? " is outside the range of a double" : " is not a finite number");
  return false;
}

bool parse_integer(std::string_view word, std::int64_t& value, std::string& problem) {
  const std::string_view digits = without_plus(word);
  const char* const end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, value);
  if (code == std::errc{} && stop == end) return true;
  problem = sentence(in_quotes(word),
                     code == std::errc::result_out_of_range ? " is far too large" : " is not a whole number");
  return false;
}

void Scanner::take_line_end() {
  const bool two = rest_.size() > 1 && rest_[0] == '\r' && rest_[1] == '\n';
  rest_.remove_prefix(two ? 2 : 1);
  ++next_line_;
}

void Scanner::skip_blank() {
  while (!rest_.empty()) {
    const char c = rest_.front();
    if (is_line_end(c)) {
      take_line_end();
    } else if (is_blank(c)) {
      rest_.remove_prefix(1);
    } else if (comment_ != 0 && c == comment_) {
      rest_of_line();
    } else {
      return;
    }
  }
}

std::string_view Scanner::word() {
  skip_blank();
  line_ = next_line_;
  std::size_t n = 0;
  while (n < rest_.size() && !is_blank(rest_[n]) && !is_line_end(rest_[n])) ++n;
  const std::string_view found = rest_.substr(0, n);
  rest_.remove_prefix(n);
  return found;
}

std::string_view Scanner::rest_of_line() {
  line_ = next_line_;
  std::size_t n = 0;
  while (n < rest_.size() && !is_line_end(rest_[n])) ++n;
  const std::string_view found = rest_.substr(0, n);
  rest_.remove_prefix(n);
  if (!rest_.empty()) take_line_end();
  return found;
}

std::string_view trimmed(std::string_view text) {
  const auto drop = [](char c) { return is_blank(c) || is_line_end(c); };
  while (!text.empty() && drop(text.front())) text.remove_prefix(1);
  while (!text.empty() && drop(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

}  // namespace impinge::io
