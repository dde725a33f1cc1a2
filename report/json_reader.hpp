// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

#include "impinge/result.hpp"
#include "report/json_file.hpp"

namespace impinge::report {

/// The value of a JSON text, taken piece by piece by what the caller expects of it. After the first mistake, in the
/// text or in what the caller expects of it, every call returns at once, and `error` says what and where.
class JsonReader {
 public:
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

  /// `name` is the file's, for messages; both must live as long as the reader.
  JsonReader(const std::string& text, std::string_view name);

  /// What stands here; null after a mistake.
  [[nodiscard]] Kind kind() const;

  /// The keys of the object that stands here, which is not taken; none of anything else.
  [[nodiscard]] std::set<std::string> keys() const;

  // Each takes the value that stands here, and it is a mistake if that is of another kind.
  std::string string() { return holds(Kind::string, "a text in quotes") ? at_->get<std::string>() : std::string(); }
  double number() { return holds(Kind::number, "a number") ? at_->get<double>() : 0; }
  bool boolean() { return holds(Kind::boolean, "true or false") && at_->get<bool>(); }
  /// Any value, whatever is in it.
  void skip() {}
  /// Calls `item()` for each item of an array.
  template <class Item>
  void array(Item&& item) {
    if (!holds(Kind::array, "a list")) return;
    const nlohmann::json& list = *at_;
    for (std::size_t i = 0; i < list.size() && !failed(); ++i) within(std::to_string(i), list[i], item);
  }
  /// Calls `member(key)` for each member of an object.
  template <class Member>
  void object(Member&& member) {
    if (!holds(Kind::object, "an object")) return;
    for (const auto& [key, value] : at_->items()) {
      if (failed()) return;
      within(key, value, [&, &known = key] { member(known); });
    }
  }

  /// A mistake that the caller found, at the value that stands here.
  void fail(std::string_view what);
  /// The JSON pointer to the value that stands here, for a mistake that is found later.
  [[nodiscard]] std::string place_of_next() const { return path_.to_string(); }
  [[nodiscard]] Error error_at(const std::string& place, std::string_view what) const {
    return json_error(name_, text_, place, what);
  }

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] const Error& error() const noexcept { return error_; }

 private:
  bool holds(Kind wanted, std::string_view what);
  void within(const std::string& step, const nlohmann::json& value, auto&& read) {
    const nlohmann::json* const around = at_;
    at_ = &value;
    path_.push_back(step);
    read();
    path_.pop_back();
    at_ = around;
  }

  const std::string& text_;
  std::string_view name_;
  nlohmann::json value_;
  const nlohmann::json* at_ = &value_;
  nlohmann::json::json_pointer path_;
  bool failed_ = false;
  Error error_{Code::bad_file, {}};
};

}  // namespace impinge::report
