// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <zlib.h>

#include <span>
#include <string>
#include <vector>

#include "report/sink.hpp"

namespace impinge::report {

/// Bytes as text within a page: compressed (zlib, RFC 1950), then base64 (RFC 4648), piece by piece.
class Encoded {
 public:
  explicit Encoded(Sink& sink);
  ~Encoded();
  Encoded(const Encoded&) = delete;
  Encoded& operator=(const Encoded&) = delete;

  /// The bytes of these numbers as they lie in memory.
  template <class Number>
  void write(std::span<const Number> numbers) {
    deflate({reinterpret_cast<const unsigned char*>(numbers.data()), numbers.size_bytes()}, Z_NO_FLUSH);
  }
  /// Ends the text. Nothing is written after it.
  void finish() { deflate({}, Z_FINISH); }

 private:
  void deflate(std::span<const unsigned char> bytes, int flush);
  /// Writes whole groups of three bytes, and the rest too at the end.
  void drain(bool is_end);

  Sink& sink_;
  z_stream stream_{};
  std::vector<unsigned char> packed_;  ///< compressed, not written yet
};

/// RFC 4648, with padding.
std::string base64(std::span<const unsigned char> bytes);

}  // namespace impinge::report
