// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "python/core/query.hpp"

#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "impinge/collide.hpp"

namespace impinge::python {

void raise(const Error& error) {
  const py::object type =
      py::module_::import("impinge._errors").attr("BY_CODE")[py::int_(static_cast<int>(error.code))];
  PyErr_SetString(type.ptr(), error.message.c_str());
  throw py::error_already_set();
}

namespace {

bool is_affine(const double* m) { return m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1; }

Pose upper_rows(const double* m) {
  return {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, {m[3], m[7], m[11]}};
}

[[noreturn]] void raise_last_row(const std::string& what) {
  raise({Code::bad_pose,
         what + " has a last row other than 0 0 0 1; a pose is a (4, 4) matrix that maps column vectors"});
}

}  // namespace

std::vector<Pose> poses_of(const View& matrices, const char* what) {
  const std::span<const double> numbers = matrices.as<double>();
  std::vector<Pose> poses(numbers.size() / 16);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const double* const m = numbers.data() + 16 * k;
    if (!is_affine(m)) raise_last_row(poses.size() == 1 ? what : what + ('[' + std::to_string(k) + ']'));
    poses[k] = upper_rows(m);
  }
  return poses;
}

Pose pose_of(py::handle matrix, const char* what) {
  if (matrix.is_none()) return {};
  const View view(matrix);
  const double* const m = view.as<double>().data();
  if (!is_affine(m)) raise_last_row(what);
  return upper_rows(m);
}

double off_rotation(py::handle matrix) {
  const View view(matrix);
  const double* const m = view.as<double>().data();
  const auto& R = upper_rows(m).R;
  const double determinant =
      R[0] * (R[4] * R[8] - R[5] * R[7]) - R[1] * (R[3] * R[8] - R[5] * R[6]) + R[2] * (R[3] * R[7] - R[4] * R[6]);
  if (!is_affine(m) || !(determinant > 0)) return std::numeric_limits<double>::infinity();
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = i; k < 3; ++k)
      off = std::max(off, std::abs(R[i] * R[k] + R[3 + i] * R[3 + k] + R[6 + i] * R[6 + k] - (i == k ? 1 : 0)));
  return off;
}

Array matrices_of(std::span<const Pose> poses) {
  std::vector<double> numbers;
  for (const auto& [R, t] : poses)
    numbers.insert(numbers.end(), {R[0], R[1], R[2], t[0], R[3], R[4], R[5], t[1], R[6], R[7], R[8], t[2], 0, 0, 0, 1});
  return array_of(std::move(numbers), "d", 8, {static_cast<py::ssize_t>(poses.size()), 4, 4});
}

Array matrix_of(const Pose& pose) {
  Array matrix = matrices_of({&pose, 1});
  matrix.shape = {4, 4};
  return matrix;
}

const char* bad_pose_of(const Pair& pair) {
  const auto nothing = Mesh::create(std::span<const double>{}, {});
  return nothing && collide(*nothing, pair.at, *nothing, {}) ? "pose_b" : "pose_a";
}

std::uint32_t process_number() {
  static std::atomic<std::uint32_t> number = 1;
  [[maybe_unused]] static const int counted = pthread_atfork(nullptr, nullptr, [] { ++number; });
  return number;
}

void Exclusive::check(const char* what) const {
  if (const std::uint32_t holder = holder_; holder != 0 && holder != process_number())
    raise({Code::bad_option, std::string("this ") + what +
                                 " was in use by another thread when the process was forked, and is half changed "
                                 "here; make a new one in the child, or fork while no thread uses it"});
}

void Exclusive::lock() {
  for (std::uint32_t holder = 0; !holder_.compare_exchange_strong(holder, process_number()); holder = 0)
    holder_.wait(holder);
}

void Exclusive::unlock() {
  holder_ = 0;
  holder_.notify_one();
}

bool is_main_thread() {
  const py::object main = py::module_::import("threading").attr("main_thread")();
  return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

}  // namespace impinge::python
