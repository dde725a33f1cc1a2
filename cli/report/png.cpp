// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/png.hpp"

#include <zlib.h>

#include <cstdint>
#include <new>
#include <string_view>

namespace impinge::cli {
namespace {

std::string big_endian(std::uint64_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
  return text;
}

std::string chunk(std::string_view type, std::string_view data) {
  std::string body = std::string(type) + std::string(data);
  const uLong crc = crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(body.data()), body.size());
  return big_endian(data.size()) + body + big_endian(crc);
}

}  // namespace

std::string png_of(const Picture& picture) {
  constexpr char kPlain = 0;  // flat colours: predicting a pixel from its neighbours gains nothing
  const std::size_t stride = 3 * picture.width;
  std::string rows;
  rows.reserve((stride + 1) * picture.height);
  for (std::size_t y = 0; y < picture.height; ++y) {
    rows += kPlain;
    rows.append(reinterpret_cast<const char*>(picture.rgb.data()) + y * stride, stride);
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  constexpr char kBits = 8, kColours = 2;
  const std::string header =
      big_endian(picture.width) + big_endian(picture.height) + std::string{kBits, kColours, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed) + chunk("IEND", {});
}

}  // namespace impinge::cli
