// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>
#include <shared_mutex>

#include "impinge/scene.hpp"

namespace impinge::python {

/// A scene that threads share. The Python above holds `mutex` around what it does with it and with its names: shared
/// for queries, alone for changes. It is waited for with the interpreter's lock released.
struct SharedScene {
  Scene scene;
  std::shared_mutex mutex;
  std::size_t triangles = 0;  ///< of all objects; kept by the Python above

  /// In a child process: threads that held the mutex when it was forked are not there to let go of it.
  void forget_threads() { new (&mutex) std::shared_mutex; }
};

}  // namespace impinge::python
