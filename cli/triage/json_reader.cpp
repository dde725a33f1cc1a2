// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "triage/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "text.hpp"

namespace impinge::cli {
namespace {

using Kind = JsonReader::Kind;

std::string_view in_words(Kind kind) {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return "true or false";
    case Kind::number:
      return "a number";
    case Kind::string:
      return "a text in quotes";
    case Kind::array:
      return "a list";
    case Kind::object:
      return "an object";
  }
  return "";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void append_utf8(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | code >> 6), add(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12), add(0x80 | (code >> 6 & 0x3F)), add(0x80 | (code & 0x3F));
  } else {
    add(0xF0 | code >> 18), add(0x80 | (code >> 12 & 0x3F)), add(0x80 | (code >> 6 & 0x3F)), add(0x80 | (code & 0x3F));
  }
}

/// Whatever a file holds, a message stays one short line.
std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  return fit(printable(text.substr(0, 4 * kLongest)), kLongest);
}

}  // namespace

JsonReader::JsonReader(std::string_view text, std::string_view name) : text_(text), name_(name) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

void JsonReader::skip_space() {
  while (here() == ' ' || here() == '\t' || here() == '\n' || here() == '\r') ++at_;
}

Kind JsonReader::kind() {
  skip_space();
  if (failed_) return Kind::null;
  last_ = at_;
  switch (here()) {
    case '{':
      return Kind::object;
    case '[':
      return Kind::array;
    case '"':
      return Kind::string;
    case 't':
    case 'f':
      return Kind::boolean;
    case 'n':
      return Kind::null;
    default:
      if (here() == '-' || is_digit(here())) return Kind::number;
  }
  fail(at_ >= text_.size() ? "the text ends where a value should stand" : "no JSON value begins so");
  return Kind::null;
}

void JsonReader::expect(Kind wanted, std::string_view what) {
  const Kind found = kind();
  if (found != wanted) fail(fmt::format("{} should stand here, not {}", what, in_words(found)));
}

bool JsonReader::enter(char open, std::string_view what) {
  expect(open == '[' ? Kind::array : Kind::object, what);
  if (path_.size() >= kDeepest) fail(fmt::format("this is nested deeper than {} levels", kDeepest));
  if (failed_) return false;
  ++at_;
  return true;
}

bool JsonReader::leave_at_once(char close) {
  skip_space();
  if (here() != close) return false;
  ++at_;
  return true;
}

bool JsonReader::goes_on(char close) {
  skip_space();
  if (failed_) return false;
  last_ = at_;
  const char c = here();
  if (c != ',' && c != close) {
    fail(at_ >= text_.size() ? fmt::format("the text ends before a closing '{}'", close)
                             : fmt::format("a ',' or a '{}' should stand here", close));
    return false;
  }
  ++at_;
  return c == ',';
}

std::string JsonReader::take_key(std::unordered_set<std::string>& seen) {
  expect(Kind::string, "a key in quotes");
  std::string key;
  if (!failed_) take_string(&key);
  if (failed_) return key;
  const std::size_t began = last_;
  path_.push_back({key, 0});
  if (!seen.insert(key).second) fail("this key stands here twice");
  take_colon();
  last_ = began;
  return key;
}

void JsonReader::take_word(std::string_view word) {
  if (text_.substr(at_).starts_with(word))
    at_ += word.size();
  else
    fail("no JSON value begins so");
}

std::string_view JsonReader::take_number() {
  const std::size_t began = at_;
  const auto digits = [&] {
    if (!is_digit(here())) fail("a digit is missing in this number");
    while (is_digit(here())) ++at_;
  };
  if (here() == '-') ++at_;
  if (here() == '0')
    ++at_;
  else
    digits();
  if (here() == '.') ++at_, digits();
  if (here() == 'e' || here() == 'E') {
    ++at_;
    if (here() == '+' || here() == '-') ++at_;
    digits();
  }
  return text_.substr(began, at_ - began);
}

std::uint32_t JsonReader::take_hex() {
  std::uint32_t code = 0;
  for (int i = 0; i < 4; ++i, ++at_) {
    const char c = here();
    const int digit = is_digit(c)            ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) {
      fail("\\u takes four hexadecimal digits");
      return 0;
    }
    code = code << 4 | static_cast<std::uint32_t>(digit);
  }
  return code;
}

/// After the backslash.
void JsonReader::take_escape(std::string* to) {
  constexpr std::string_view kLetters = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
  const char c = here();
  ++at_;
  if (const std::size_t i = kLetters.find(c); i != std::string_view::npos) {
    if (to != nullptr) *to += kMeant[i];
    return;
  }
  if (c != 'u') return fail("there is no such escape in a JSON text");
  std::uint32_t code = take_hex();
  if (code >= 0xD800 && code < 0xDC00 && text_.substr(at_).starts_with("\\u")) {
    at_ += 2;
    const std::uint32_t low = take_hex();
    if (low < 0xDC00 || low > 0xDFFF) return fail("half of a surrogate pair is missing");
    code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
  } else if (code >= 0xD800 && code <= 0xDFFF) {
    return fail("half of a surrogate pair is missing");
  }
  if (to != nullptr) append_utf8(*to, code);
}

/// `to` may be null.
void JsonReader::take_string(std::string* to) {
  ++at_;
  while (!failed_) {
    if (at_ >= text_.size()) return fail("this text in quotes never ends");
    const auto byte = static_cast<unsigned char>(text_[at_]);
    if (byte == '"') {
      ++at_;
      return;
    }
    if (byte < 0x20) return fail("a control character stands in this text in quotes; write it as an escape");
    if (byte == '\\') {
      ++at_;
      take_escape(to);
      continue;
    }
    const Character character = decode(text_, at_);
    if (!character.valid) return fail("this text in quotes is not UTF-8");
    if (to != nullptr) to->append(text_.substr(at_, character.length));
    at_ += character.length;
  }
}

std::string JsonReader::string() {
  std::string text;
  expect(Kind::string, in_words(Kind::string));
  if (!failed_) take_string(&text);
  return text;
}

double JsonReader::number() {
  expect(Kind::number, in_words(Kind::number));
  if (failed_) return 0;
  const std::string_view digits = take_number();
  if (failed_) return 0;
  double value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // What is too small becomes 0 or nearly so, as in every other reader; the program never leaves the locale "C".
  if (problem == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
  if (!std::isfinite(value)) fail("this number is too large");
  return value;
}

bool JsonReader::boolean() {
  expect(Kind::boolean, in_words(Kind::boolean));
  if (failed_) return false;
  const bool value = here() == 't';
  take_word(value ? "true" : "false");
  return value;
}

void JsonReader::skip() {
  std::string open;  // what closes the brackets that are open
  while (true) {
    switch (kind()) {
      case Kind::null:
        if (!failed_) take_word("null");
        break;
      case Kind::boolean:
        take_word(here() == 't' ? "true" : "false");
        break;
      case Kind::number:
        take_number();
        break;
      case Kind::string:
        take_string(nullptr);
        break;
      case Kind::array:
      case Kind::object:
        if (path_.size() + open.size() >= kDeepest)
          return fail(fmt::format("this is nested deeper than {} levels", kDeepest));
        open += here() == '[' ? ']' : '}';
        ++at_;
        if (leave_at_once(open.back())) {
          open.pop_back();
          break;
        }
        if (open.back() == '}') skip_key();
        if (failed_) return;
        continue;
    }
    while (!failed_ && !open.empty() && !goes_on(open.back())) open.pop_back();
    if (failed_ || open.empty()) return;
    if (open.back() == '}') skip_key();
    if (failed_) return;
  }
}

void JsonReader::skip_key() {
  expect(Kind::string, "a key in quotes");
  if (!failed_) take_string(nullptr);
  take_colon();
}

void JsonReader::take_colon() {
  if (failed_) return;
  skip_space();
  if (here() == ':') {
    ++at_;
    return;
  }
  last_ = at_;
  fail("a ':' should stand after a key");
}

void JsonReader::end() {
  skip_space();
  last_ = at_;
  if (!failed_ && at_ < text_.size()) fail("something stands after the end of the JSON text");
}

JsonReader::Place JsonReader::place() const {
  Place place{last_, {}};
  for (const Step& step : path_)
    place.path += step.key.empty() ? fmt::format("/{}", step.index) : "/" + shown(step.key);
  return place;
}

Error JsonReader::error_at(const Place& place, std::string_view what) const {
  const auto line = 1 + std::count(text_.begin(),
                                   text_.begin() + static_cast<std::ptrdiff_t>(std::min(place.at, text_.size())), '\n');
  return {Code::bad_file, fmt::format("{}:{}: {}{}", name_, line, place.path.empty() ? "" : place.path + ": ", what)};
}

void JsonReader::fail(std::string_view what) {
  if (failed_) return;
  failed_ = true;
  error_ = error_at(place(), what);
}

void JsonReader::fail_unknown(std::string_view key, const std::vector<std::string_view>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
    return edit_distance(key, a) < edit_distance(key, b);
  });
  fail(fmt::format("there is no '{}' here; did you mean '{}'?", shown(key), *nearest));
}

}  // namespace impinge::cli
