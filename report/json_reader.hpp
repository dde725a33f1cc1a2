// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "impinge/result.hpp"

namespace impinge::report {

/// A JSON text (RFC 8259), taken value by value by what the caller expects of it. nlohmann-json parses it; its own
/// values do not tell where in the file they stood, nor keys that stand twice, so this keeps both. After the first
/// mistake, in the text or in what the caller expects of it, every call returns at once, and `error` says what and
/// where. No input makes anything recurse deeper than `kDeepest`, or be kept beyond `kMostValues`.
class JsonReader {
 public:
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };
  static constexpr std::size_t kDeepest = 64, kMostValues = 50'000'000;

  /// `name` is the file's, for messages; both must live as long as the reader.
  JsonReader(std::string_view text, std::string_view name);

  /// What stands here; null after a mistake.
  [[nodiscard]] Kind kind();

  /// The keys of the object that stands here, which is not taken; none of anything else.
  [[nodiscard]] std::set<std::string> keys();

  // Each takes the value that stands here, and it is a mistake if that is of another kind.
  std::string string();
  double number();
  bool boolean();
  /// Any value, whatever is in it.
  void skip();
  /// Calls `item()` for each item of an array; it must take the item.
  template <class Item>
  void array(Item&& item) {
    const std::size_t past = enter(Kind::array);
    for (std::size_t i = 0; !failed() && next_ < past; ++i) {
      path_.push_back({{}, i});
      item();
      if (!failed()) path_.pop_back();
    }
  }
  /// Calls `member(key)` for each member of an object; it must take the member's value. A key that stands twice is a
  /// mistake.
  template <class Member>
  void object(Member&& member) {
    const std::size_t past = enter(Kind::object);
    std::unordered_set<std::string> seen;
    while (!failed() && next_ < past) {
      const std::string key = take_key(seen);
      if (!failed()) member(key);
      if (!failed()) path_.pop_back();
    }
  }

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
  [[nodiscard]] Error error_at(const Place& place, std::string_view what) const {
    return error_in(text_, name_, place, what);
  }
  /// `bad_file`: "clash.json:12: /tests/0/mode: what is wrong".
  static Error error_in(std::string_view text, std::string_view name, const Place& place, std::string_view what);

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] const Error& error() const noexcept { return error_; }

 private:
  class Parser;
  /// A value or a key; those within an array or object come after it.
  struct Token {
    std::size_t at = 0;      ///< where in the text it ends, or begins if it is an array or object
    double number = 0;       ///< also that of a boolean
    std::size_t link = 0;    ///< of a string: where it begins in `strings_`; else the token after all that is within
    std::uint32_t size = 0;  ///< of a string
    Kind kind = Kind::null;
  };
  struct Step {
    std::string key;
    std::size_t index;
  };
  const Token* take(Kind wanted, std::string_view what);
  std::size_t enter(Kind wanted);
  std::string take_key(std::unordered_set<std::string>& seen);
  [[nodiscard]] std::string_view string_of(const Token& token) const;

  std::string_view text_, name_;
  std::vector<Token> tokens_;
  std::string strings_;
  std::size_t next_ = 0, last_ = 0;  ///< `last_`: where the value or key stands that was taken last
  std::vector<Step> path_;
  bool failed_ = false;
  Error error_{Code::bad_file, {}};
};

}  // namespace impinge::report
