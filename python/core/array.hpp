// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

/// Arrays from and to Python, by the buffer protocol alone.
namespace impinge::python {

namespace py = pybind11;

/// Numbers that Python sees as an array, without a copy: `numpy.asarray(array)` keeps their owner alive.
struct Array {
  std::shared_ptr<const void> owner;
  void* data = nullptr;
  const char* format = "d";  ///< of the module struct: d, i, q, b, B or ?
  py::ssize_t itemsize = 0;
  std::vector<py::ssize_t> shape;
  bool readonly = false;
};

/// A vector of structs that consist of numbers of one type, as an array of these numbers. Indices below 2^31 and
/// offsets below 2^63 are handed out as signed numbers: those of numpy's unsigned types wrap when they are subtracted.
template <class T>
Array array_of(std::vector<T>&& values, const char* format, py::ssize_t itemsize, std::vector<py::ssize_t> shape) {
  auto owner = std::make_shared<std::vector<T>>(std::move(values));
  void* const data = owner->data();
  return {std::move(owner), data, format, itemsize, std::move(shape), false};
}

/// A C-contiguous array of numbers that Python owns. Whoever calls has converted it: its type is not looked at again.
class View {
 public:
  explicit View(py::handle object) {
    if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_C_CONTIGUOUS) != 0) throw py::error_already_set();
  }
  ~View() { PyBuffer_Release(&buffer_); }
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {static_cast<const std::byte*>(buffer_.buf), static_cast<std::size_t>(buffer_.len)};
  }
  template <class T>
  [[nodiscard]] std::span<const T> as() const {
    if (buffer_.itemsize != static_cast<py::ssize_t>(sizeof(T)))
      throw std::invalid_argument("an array of another type");
    return {static_cast<const T*>(buffer_.buf), static_cast<std::size_t>(buffer_.len) / sizeof(T)};
  }

 private:
  Py_buffer buffer_{};
};

/// The numbers of a C-contiguous array that Python owns, as structs that consist of them.
template <class T>
std::vector<T> copy_of(py::handle array) {
  const View view(array);
  std::vector<T> values(view.bytes().size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), view.bytes().data(), values.size() * sizeof(T));
  return values;
}

}  // namespace impinge::python
