// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/result.hpp"
#include "io/text.hpp"

namespace impinge::io {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
[[nodiscard]] std::size_t bytes_of(PlyType type);
[[nodiscard]] inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type;  ///< of a list: of its items
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format : std::uint8_t { text, little_endian, big_endian };
  Format format;
  std::vector<PlyElement> elements;
  std::size_t body_byte;    ///< where the body begins
  std::uint64_t body_line;  ///< the line that it begins on
  std::vector<std::string> warnings;
};

Result<PlyHeader> read_ply_header(std::string_view bytes, const Source& source);

}  // namespace impinge::io
