// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "impinge/result.hpp"

namespace impinge {

/// Thrown where a caller's stop token ends a computation from deep within; `guarded` makes an error of it.
struct Stopped {};

inline Error cancelled() { return {Code::cancelled, "the query was stopped before it was complete"}; }

inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

/// A comparison for sorts that may take long: it throws `Stopped`.
template <class Less>
auto until_stopped(const std::stop_token& stop, const Less& less) {
  return [&stop, less](const auto& x, const auto& y) {
    throw_if_stopped(stop);
    return less(x, y);
  };
}

}  // namespace impinge
