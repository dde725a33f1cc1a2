// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "python/core/array.hpp"

/// How a call of the library is made from Python: without the interpreter's lock, and so that Ctrl-C ends it.
namespace impinge::python {

/// Ends the queries that are given it.
struct Stop {
  std::stop_source source;
};

/// Lets go of the interpreter's lock. pybind11's gil_scoped_release ends the process where the interpreter ends
/// meanwhile: a thread that wants the lock back is unwound then, out of a destructor. This one waits for the end of the
/// process.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() {
    try {
      PyEval_RestoreThread(state_);
    } catch (...) {  // nothing but that unwinding, which may not end here
      for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Throws the package's exception for the error.
[[noreturn]] void raise(const Error& error);

inline const Error kStopped{Code::cancelled, "the query was stopped before it was complete"};

/// Of this process: a child that is forked has another one than the processes that it comes of.
std::uint32_t process_number();

/// A mutex that knows the process whose thread holds it.
class Exclusive {
 public:
  /// Throws the package's exception where it was held when this process was forked: who held it is not here to end what
  /// it was changing. With the interpreter's lock; `what` names the object that it guards.
  void check(const char* what) const;
  void lock();
  void unlock();

 private:
  std::atomic<std::uint32_t> holder_ = 0;  ///< 0: nobody
};

template <class T>
T unwrap(Result<T> result) {
  if (!result.has_value()) raise(result.error());
  return *std::move(result);
}
inline void unwrap(Result<void> result) {
  if (!result.has_value()) raise(result.error());
}

/// An array of (4, 4) matrices as poses. Errors: `bad_pose`, with `what` and the index of one whose last row is not 0 0
/// 0 1.
std::vector<Pose> poses_of(const View& matrices, const char* what);
/// One matrix; None is the identity.
Pose pose_of(py::handle matrix, const char* what);

/// max|RᵀR - I| of a (4, 4) matrix; infinity for a mirror image, or with another last row than 0 0 0 1.
double off_rotation(py::handle matrix);

/// The (N, 4, 4) matrices of poses, and the (4, 4) matrix of one.
Array matrices_of(std::span<const Pose> poses);
Array matrix_of(const Pose& pose);

/// From how many triangles on, counted with each pose, a query may take so long that somebody presses Ctrl-C. Below,
/// the helper thread that it needs would cost more than many a query.
inline constexpr std::size_t kMayTakeLong = 20'000;

/// Whether Python delivers signals to this thread.
bool is_main_thread();

/// What `query(stop_token)` returns, with the interpreter's lock released meanwhile. `size` is the number of triangles.
/// On the main thread a large query runs on a helper thread, while this one looks for signals: a handler that raises,
/// as that of Ctrl-C does, ends the query by its stop token, and its exception is thrown.
template <class Query>
auto run(const Stop* stop, std::size_t size, Query query) {
  using Answer = decltype(query(std::stop_token{}));
  const std::stop_token asked = stop != nullptr ? stop->source.get_token() : std::stop_token{};
  if (size < kMayTakeLong || !is_main_thread()) {
    const Unlocked released;
    return query(asked);
  }

  std::stop_source source;
  const std::stop_callback forward(asked, [&] { source.request_stop(); });
  std::optional<Answer> answer;
  std::exception_ptr failure;
  std::optional<py::error_already_set> signal;
  {
    const Unlocked released;
    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    const auto work = [&] {
      try {
        answer.emplace(query(source.get_token()));
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      changed.notify_one();
    };
    std::thread helper;
    try {
      helper = std::thread(work);
    } catch (const std::system_error&) {
      work();  // no thread is to be had: Ctrl-C waits for the end
    }
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      lock.unlock();
      if (!signal) {
        const py::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) signal.emplace();
      }
      if (signal) source.request_stop();
      lock.lock();
    }
    lock.unlock();
    if (helper.joinable()) helper.join();
  }
  if (signal) throw py::error_already_set(*std::exchange(signal, std::nullopt));
  if (failure) std::rethrow_exception(failure);
  return *std::move(answer);
}

/// Two placed meshes.
struct Pair {
  Mesh a;
  Pose at;
  Mesh b;
  Pose bt;
};

/// Makes `function(pair, ...)` a function of Python's of a mesh, its pose, another mesh, its pose, and so on.
template <class Answer, class... Arguments>
void bind_pair(py::module_& module, const char* name, Answer (*function)(const Pair&, Arguments...)) {
  module.def(name, [function](const Mesh& a, py::handle pose_a, const Mesh& b, py::handle pose_b, Arguments... rest) {
    return function({a, pose_of(pose_a, "pose_a"), b, pose_of(pose_b, "pose_b")}, rest...);
  });
}

/// Which of the poses is none, for the error that says so.
const char* bad_pose_of(const Pair& pair);

/// What `query(stop_token)` answers about the pair; throws its error.
template <class Query>
auto run_pair(const Pair& pair, const Stop* stop, Query query) {
  auto answer = run(stop, pair.a.triangle_count() + pair.b.triangle_count(), query);
  if (!answer.has_value() && answer.error().code == Code::bad_pose)
    raise({Code::bad_pose, bad_pose_of(pair) + (": " + answer.error().message)});
  return unwrap(std::move(answer));
}

}  // namespace impinge::python
