// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/json_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>
#include <unordered_set>
#include <vector>

#include "report/text.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

/// Reads a text without building its value: finds the first mistake in it, or the place that a JSON pointer names.
/// nlohmann-json's own values keep neither their places in the text nor keys that stand twice.
class JsonScan final : public nlohmann::json_sax<json> {
 public:
  /// An empty pointer names no place: the whole text is read.
  explicit JsonScan(const std::string& text, json::json_pointer wanted = json::json_pointer(),
                    std::size_t most_values = kMostJsonValues)
      : text_(text), in_(text), wanted_(std::move(wanted)), most_values_(most_values) {
    stopped_ = !json::sax_parse(in_, this);
  }

  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] const std::string& mistake() const { return mistake_; }
  [[nodiscard]] const json::json_pointer& pointer() const { return pointer_; }
  [[nodiscard]] std::size_t line() const {
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + at_, '\n'));
  }
  [[nodiscard]] std::size_t column() const {
    const std::size_t line_break = std::string_view(text_).substr(0, static_cast<std::size_t>(at_)).rfind('\n');
    return static_cast<std::size_t>(at_) - (line_break + 1) + 1;  // without a line break, npos + 1 is 0
  }

  bool null() override { return begin_value() && end_value(); }
  bool boolean(bool) override { return begin_value() && end_value(); }
  bool number_integer(number_integer_t) override { return begin_value() && end_value(); }
  bool number_unsigned(number_unsigned_t) override { return begin_value() && end_value(); }
  bool number_float(number_float_t, const string_t&) override { return begin_value() && end_value(); }
  bool string(string_t&) override { return begin_value() && end_value(); }
  bool binary(binary_t&) override { return false; }  // no JSON text has any
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& key) override {
    pointer_.push_back(key);
    if (!open_.back().keys.insert(key).second) return stop("this key stands here twice");
    return go_on();
  }
  bool parse_error(std::size_t, const std::string&, const json::exception& problem) override {
    pointer_ = json::json_pointer();
    if (problem.id == kOverflow) return stop("this number is too large");
    // After the words that name the exception and count lines and columns.
    const std::string_view what = problem.what();
    const std::size_t colon = what.find(": ");
    return stop(fit(printable(what.substr(colon == std::string_view::npos ? 0 : colon + 2).substr(0, 800)), 160));
  }

 private:
  static constexpr int kOverflow = 406;  // nlohmann-json's number for it

  /// An array or object that has begun and not ended.
  struct Open {
    bool is_array;
    std::size_t next = 0;
    std::unordered_set<std::string> keys{};
  };

  bool stop(std::string what) {
    mistake_ = std::move(what);
    note_place();
    return false;
  }
  /// The parser has just read a value or key: it stands one further, and behind a number two.
  void note_place() {
    const auto read = static_cast<std::ptrdiff_t>(in_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
    at_ = std::max<std::ptrdiff_t>(read - 1, 0);
  }
  bool go_on() {
    if (wanted_.empty() || pointer_ != wanted_) return true;
    note_place();
    return false;
  }
  bool begin_value() {
    if (++values_ > most_values_) return stop(fmt::format("there are more than {} values here", most_values_));
    if (open_.empty() || !open_.back().is_array) return true;
    pointer_.push_back(std::to_string(open_.back().next++));
    return go_on();
  }
  bool end_value() {
    if (!open_.empty()) pointer_.pop_back();
    return true;
  }
  bool open(bool is_array) {
    if (!begin_value()) return false;
    if (open_.size() >= kDeepestJson) return stop(fmt::format("this is nested deeper than {} levels", kDeepestJson));
    open_.push_back({is_array});
    return true;
  }
  bool close() {
    open_.pop_back();
    return end_value();
  }

  const std::string& text_;
  std::istringstream in_;
  json::json_pointer wanted_, pointer_;
  std::vector<Open> open_;
  std::size_t values_ = 0;
  std::size_t most_values_;
  std::ptrdiff_t at_ = 0;
  std::string mistake_;
  bool stopped_ = false;
};

/// Builds the value of a sound text without the members that are not wanted. The filter that nlohmann-json's own parser
/// takes makes it search all of an array after each object in it.
class JsonBuilder final : public nlohmann::json_sax<json> {
 public:
  explicit JsonBuilder(const std::function<bool(const std::string& key)>& keeps) : keeps_(keeps) {}

  json take() { return std::move(root_); }

  bool null() override { return place(nullptr), true; }
  bool boolean(bool value) override { return place(value), true; }
  bool number_integer(number_integer_t value) override { return place(value), true; }
  bool number_unsigned(number_unsigned_t value) override { return place(value), true; }
  bool number_float(number_float_t value, const string_t&) override { return place(value), true; }
  bool string(string_t& value) override { return place(std::move(value)), true; }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open_.push_back(place(json::object())), true; }
  bool start_array(std::size_t) override { return open_.push_back(place(json::array())), true; }
  bool end_object() override { return open_.pop_back(), true; }
  bool end_array() override { return open_.pop_back(), true; }
  bool key(string_t& key) override { return key_ = std::move(key), true; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 private:
  /// Where the value stands now; null if it is left out.
  json* place(json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    json* const parent = open_.back();
    if (parent == nullptr) return nullptr;
    if (parent->is_array()) return &parent->emplace_back(std::move(value));
    return keeps_(key_) ? &((*parent)[key_] = std::move(value)) : nullptr;
  }

  const std::function<bool(const std::string& key)>& keeps_;
  json root_;
  std::vector<json*> open_;  ///< arrays and objects that have begun and not ended
  std::string key_;
};

std::string shown_pointer(const std::string& pointer) {
  return pointer.empty() ? std::string() : fit(printable(pointer.substr(0, 800)), 160) + ": ";
}

}  // namespace

Result<std::string> read_text_file(const std::string& name, std::uint64_t most_bytes) {
  const auto bad = [&](const std::string& why) {
    return Error{Code::bad_file, fmt::format("{} cannot be read: {}", printable(name), why)};
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), &std::fclose);
  if (file == nullptr) return bad(std::strerror(errno));
  std::string text;
  // Not by the size that the system tells: a pipe has none.
  char buffer[1 << 16];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get())) {
    text.append(buffer, count);
    if (text.size() > most_bytes) return bad(fmt::format("it is larger than {} bytes", grouped(most_bytes)));
  }
  if (std::ferror(file.get()) != 0) return bad(std::strerror(errno));
  return text;
}

Result<json> parse_json(std::string_view name, const std::string& text,
                        const std::function<bool(const std::string& key)>& keeps, std::size_t most_values) {
  const JsonScan scan(text, json::json_pointer(), most_values);
  if (scan.stopped())
    return Error{Code::bad_file, fmt::format("{}:{}: column {}: {}{}", name, scan.line(), scan.column(),
                                             shown_pointer(scan.pointer().to_string()), scan.mistake())};
  if (!keeps) return json::parse(text);
  JsonBuilder builder(keeps);
  json::sax_parse(text, &builder);
  return builder.take();
}

Error json_error(std::string_view name, const std::string& text, const std::string& pointer, std::string_view what) {
  const JsonScan scan(text, json::json_pointer(pointer));
  return {Code::bad_file,
          fmt::format("{}:{}: {}{}", name, scan.stopped() ? scan.line() : 1, shown_pointer(pointer), what)};
}

}  // namespace impinge::report
