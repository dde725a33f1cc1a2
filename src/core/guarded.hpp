// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <stdexcept>

#include "core/float_environment.hpp"
#include "core/stopped.hpp"

namespace impinge {

/// The border of the public API: runs `body` in the library's floating-point environment and makes an error of memory
/// that ran out, wherever it did (contract 3.2 and 5.3), and of a stop token. `body` returns a Result.
template <class Body>
auto guarded(const Body& body) -> decltype(body()) {
  const FloatEnvironment nearest;
  try {
    return body();
  } catch (const Stopped&) {
    return cancelled();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {  // a container asked for more than can be addressed
  }
  return Error{Code::out_of_memory, "memory ran out; free some, or cut the meshes into parts"};
}

}  // namespace impinge
