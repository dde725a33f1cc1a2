// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/text.hpp"

namespace impinge::report {
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

/// Whatever a file holds, a message stays one short line.
std::string shown(std::string_view text, std::size_t longest = 80) {
  return fit(printable(text.substr(0, 4 * longest)), longest);
}

/// Where the parser is, seen from outside of it.
struct Cursor {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char** at;

  reference operator*() const { return **at; }
  Cursor& operator++() { return ++*at, *this; }
  friend bool operator!=(const Cursor& a, const Cursor& b) { return *a.at != *b.at; }
};

}  // namespace

/// Keeps what a text says, in its order.
class JsonReader::Parser final : public nlohmann::json::json_sax_t {
 public:
  explicit Parser(JsonReader& to) : to_(to), at_(to.text_.data()), end_(at_ + to.text_.size()) {}

  void parse() { nlohmann::json::sax_parse(Cursor{&at_}, Cursor{&end_}, this); }

  bool null() override { return add({.kind = Kind::null}); }
  bool boolean(bool truth) override { return add({.number = truth ? 1.0 : 0.0, .kind = Kind::boolean}); }
  bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool string(string_t& text) override {
    if (text.size() > std::numeric_limits<std::uint32_t>::max()) return fail("this text in quotes is too long");
    const std::size_t begin = to_.strings_.size();
    to_.strings_ += text;
    return add({.link = begin, .size = static_cast<std::uint32_t>(text.size()), .kind = Kind::string});
  }
  bool key(string_t& text) override { return string(text); }
  bool binary(binary_t&) override { return false; }  // no JSON text has any
  bool start_object(std::size_t) override { return open(Kind::object); }
  bool start_array(std::size_t) override { return open(Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& problem) override {
    if (problem.id == kOverflow) return fail("this number is too large");
    // After the words that name the exception and count lines and columns.
    const std::string_view what = problem.what();
    const std::size_t colon = what.find(": ");
    return fail(shown(colon == std::string_view::npos ? what : what.substr(colon + 2), 160));
  }

 private:
  static constexpr int kOverflow = 406;  // nlohmann-json's number for it

  /// A value has just been read: the parser stands behind it, one further behind a number.
  [[nodiscard]] std::size_t here() const {
    const auto read = static_cast<std::size_t>(at_ - to_.text_.data());
    return read == 0 ? 0 : read - 1;
  }
  bool fail(std::string_view what) {
    to_.last_ = here();
    to_.fail(what);
    return false;
  }
  bool add(Token token) {
    if (to_.tokens_.size() >= kMostValues) return fail(fmt::format("there are more than {} values here", kMostValues));
    token.at = here();
    if (token.kind != Kind::string) token.link = to_.tokens_.size() + 1;
    to_.tokens_.push_back(token);
    return true;
  }
  bool add_number(double value) { return add({.number = value, .kind = Kind::number}); }
  bool open(Kind kind) {
    if (open_.size() >= kDeepest) return fail(fmt::format("this is nested deeper than {} levels", kDeepest));
    open_.push_back(to_.tokens_.size());
    return add({.kind = kind});
  }
  bool close() {
    to_.tokens_[open_.back()].link = to_.tokens_.size();
    open_.pop_back();
    return true;
  }

  JsonReader& to_;
  const char *at_, *end_;
  std::vector<std::size_t> open_;
};

JsonReader::JsonReader(std::string_view text, std::string_view name) : text_(text), name_(name) {
  Parser(*this).parse();
}

Kind JsonReader::kind() {
  if (failed_ || next_ >= tokens_.size()) return Kind::null;
  last_ = tokens_[next_].at;
  return tokens_[next_].kind;
}

std::set<std::string> JsonReader::keys() {
  std::set<std::string> keys;
  if (kind() != Kind::object) return keys;
  for (std::size_t at = next_ + 1; at < tokens_[next_].link;) {
    keys.emplace(string_of(tokens_[at++]));
    at = tokens_[at].kind == Kind::string ? at + 1 : tokens_[at].link;
  }
  return keys;
}

/// Null after a mistake.
const JsonReader::Token* JsonReader::take(Kind wanted, std::string_view what) {
  const Kind found = kind();
  if (found != wanted) fail(fmt::format("{} should stand here, not {}", what, in_words(found)));
  return failed_ ? nullptr : &tokens_[next_++];
}

std::string_view JsonReader::string_of(const Token& token) const {
  return std::string_view(strings_).substr(token.link, token.size);
}

std::string JsonReader::string() {
  const Token* const token = take(Kind::string, in_words(Kind::string));
  return token == nullptr ? std::string() : std::string(string_of(*token));
}

double JsonReader::number() {
  const Token* const token = take(Kind::number, in_words(Kind::number));
  return token == nullptr ? 0 : token->number;
}

bool JsonReader::boolean() {
  const Token* const token = take(Kind::boolean, in_words(Kind::boolean));
  return token != nullptr && token->number != 0;
}

void JsonReader::skip() {
  const Kind found = kind();
  if (failed_ || next_ >= tokens_.size()) return;
  next_ = found == Kind::string ? next_ + 1 : tokens_[next_].link;
}

/// Returns the token after all that is within; nothing after a mistake.
std::size_t JsonReader::enter(Kind wanted) {
  const Token* const token = take(wanted, in_words(wanted));
  return token == nullptr ? 0 : token->link;
}

std::string JsonReader::take_key(std::unordered_set<std::string>& seen) {
  last_ = tokens_[next_].at;
  std::string key(string_of(tokens_[next_++]));
  path_.push_back({key, 0});
  if (!seen.insert(key).second) fail("this key stands here twice");
  return key;
}

JsonReader::Place JsonReader::place() const {
  Place place{last_, {}};
  for (const Step& step : path_)
    place.path += step.key.empty() ? fmt::format("/{}", step.index) : "/" + shown(step.key);
  return place;
}

Error JsonReader::error_in(std::string_view text, std::string_view name, const Place& place, std::string_view what) {
  const std::string_view before = text.substr(0, std::min(place.at, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return {Code::bad_file, fmt::format("{}:{}: {}{}", name, line, place.path.empty() ? "" : place.path + ": ", what)};
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

}  // namespace impinge::report
