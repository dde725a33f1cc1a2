// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <shared_mutex>

#include "impinge/scene.hpp"
#include "python/core/query.hpp"

namespace impinge::python {

/// A scene that threads share. The Python above holds `mutex` around what it does with it and with its names: shared
/// for queries, alone for changes. It is waited for with the interpreter's lock released.
struct SharedScene {
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();  ///< for queries; clashes that were found keep it too
  std::shared_mutex mutex;
  std::atomic<bool> stale = false;  ///< it was changed since `Scene::update`
  std::size_t triangles = 0;        ///< of all objects; kept by the Python above

  /// For changes: a copy of its own if others keep the scene as it is.
  Scene& own();

  // For `Hold` alone, with the interpreter's lock.
  bool changing = false;                     ///< somebody holds the mutex alone
  std::uint32_t process = process_number();  ///< whose threads may hold the mutex
  bool spoilt = false;                       ///< half changed by a thread that is not in this process

  /// In a child process, lets go of the mutex for threads that held it when it was forked.
  void forget_threads_of_parent();
};

}  // namespace impinge::python
