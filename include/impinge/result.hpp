// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace impinge {

/// Why a call gave no answer.
enum class Code : std::uint8_t {
  bad_mesh,       ///< vertices or triangles that cannot be a mesh
  bad_pose,       ///< a pose that is not finite and nearly a rotation, or an affine map that is not finite
  out_of_range,   ///< world coordinates outside the range in which every answer is exact
  bad_option,     ///< an option with a value that it cannot have
  unknown_id,     ///< an object id that this scene never gave out, or whose object was removed
  bad_file,       ///< a file that cannot be read, or whose contents are not what its format says
  cancelled,      ///< the caller's stop token asked for it
  no_device,      ///< no device that can run the backend asked for
  out_of_memory,  ///< memory ran out; what the call worked on is as it was, and may be asked again
  in_contact,     ///< meshes touch that must be apart
};

/// What went wrong, in a sentence that names the place and the mend.
struct Error {
  Code code;
  std::string message;
};

/// A value, or the reason why there is none. Reading the wrong one is a caller's bug, caught by `assert`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const noexcept { return state_.index() == 0; }
  /// Not for a `Result<bool>`, where it would be taken for the answer: ask `has_value()`.
  explicit operator bool() const noexcept requires(!std::is_same_v<T, bool>) { return has_value(); }

  [[nodiscard]] T& value() & { return assert(has_value()), *std::get_if<0>(&state_); }
  [[nodiscard]] const T& value() const& { return assert(has_value()), *std::get_if<0>(&state_); }
  [[nodiscard]] T&& value() && { return assert(has_value()), std::move(*std::get_if<0>(&state_)); }
  [[nodiscard]] const Error& error() const { return assert(!has_value()), *std::get_if<1>(&state_); }

  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the reason for the failure.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const Error& error() const { return assert(!has_value()), *std::get_if<1>(&state_); }

 private:
  std::variant<std::monostate, Error> state_;
};

}  // namespace impinge
