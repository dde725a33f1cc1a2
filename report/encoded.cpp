// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/encoded.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string_view>

namespace impinge::report {

Encoded::Encoded(Sink& sink) : sink_(sink) {
  if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
}

Encoded::~Encoded() { deflateEnd(&stream_); }

void Encoded::deflate(std::span<const unsigned char> bytes, int flush) {
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  std::array<unsigned char, 1 << 16> out{};
  int state = Z_OK;
  do {
    const std::size_t some = std::min(bytes.size(), kMost);
    stream_.next_in = const_cast<unsigned char*>(bytes.data());  // zlib's older interface; it only reads
    stream_.avail_in = static_cast<uInt>(some);
    bytes = bytes.subspan(some);
    do {
      stream_.next_out = out.data();
      stream_.avail_out = static_cast<uInt>(out.size());
      state = ::deflate(&stream_, bytes.empty() ? flush : Z_NO_FLUSH);
      packed_.insert(packed_.end(), out.begin(), out.end() - stream_.avail_out);
      drain(false);
    } while (stream_.avail_out == 0);
  } while (!bytes.empty());
  if (state == Z_STREAM_END) drain(true);
}

void Encoded::drain(bool is_end) {
  const std::size_t whole = is_end ? packed_.size() : packed_.size() - packed_.size() % 3;
  sink_.write(base64(std::span(packed_).first(whole)));
  packed_.erase(packed_.begin(), packed_.begin() + static_cast<std::ptrdiff_t>(whole));
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace impinge::report
