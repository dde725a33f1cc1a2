// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "impinge/result.hpp"

namespace impinge::cli {

/// Reads a JSON text (RFC 8259) value by value: nothing is kept but what the caller keeps. After the first mistake, in
/// the text or in what the caller expects of it, every call returns at once, and `error` says what and where. No
/// input makes it recurse deeper than `kDeepest`.
class JsonReader {
 public:
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };
  static constexpr std::size_t kDeepest = 64;

  /// `name` is the file's, for messages; both must live as long as the reader.
  JsonReader(std::string_view text, std::string_view name);

  /// What stands here; null after a mistake.
  [[nodiscard]] Kind kind();

  // Each takes the value that stands here, and it is a mistake if that is of another kind.
  std::string string();
  double number();
  bool boolean();
  /// Any value, whatever is in it.
  void skip();
  /// Calls `item()` for each item of an array; it must take the item.
  template <class Item>
  void array(Item&& item) {
    if (!enter('[', "a list")) return;
    std::size_t count = 0;
    for (bool more = !leave_at_once(']'); more && !failed(); more = goes_on(']')) {
      path_.push_back({{}, count++});
      item();
      if (!failed()) path_.pop_back();
    }
  }
  /// Calls `member(key)` for each member of an object; it must take the member's value. A key that stands twice is a
  /// mistake.
  template <class Member>
  void object(Member&& member) {
    if (!enter('{', "an object")) return;
    std::unordered_set<std::string> seen;
    for (bool more = !leave_at_once('}'); more && !failed(); more = goes_on('}')) {
      const std::string key = take_key(seen);
      if (failed()) return;
      member(key);
      if (!failed()) path_.pop_back();
    }
  }
  /// Nothing but space may follow.
  void end();

  /// A mistake that the caller found, at the value or key that was read last.
  void fail(std::string_view what);
  /// What "an unknown key" says, with the nearest of those that are known.
  void fail_unknown(std::string_view key, const std::vector<std::string_view>& known);
  /// A mistake at a place that was kept.
  struct Place {
    std::size_t at = 0;
    std::string path;
  };
  [[nodiscard]] Place place() const;
  /// That of the value that comes next.
  [[nodiscard]] Place place_of_next() { return static_cast<void>(kind()), place(); }
  [[nodiscard]] Error error_at(const Place& place, std::string_view what) const;

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  /// `bad_file`: "clash.json:12: /tests/0/mode: what is wrong".
  [[nodiscard]] const Error& error() const noexcept { return error_; }

 private:
  struct Step {
    std::string key;
    std::size_t index;
  };
  void skip_space();
  bool enter(char open, std::string_view what);
  bool leave_at_once(char close);
  bool goes_on(char close);
  std::string take_key(std::unordered_set<std::string>& seen);
  void take_colon();
  void skip_key();
  void take_word(std::string_view word);
  std::string_view take_number();
  void take_string(std::string* to);
  void take_escape(std::string* to);
  std::uint32_t take_hex();
  void expect(Kind kind, std::string_view what);
  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::string_view text_, name_;
  std::size_t at_ = 0, last_ = 0;  ///< `last_`: where the value or key began that was taken last
  std::vector<Step> path_;
  bool failed_ = false;
  Error error_{Code::bad_file, {}};
};

}  // namespace impinge::cli
