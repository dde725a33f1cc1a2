// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace impinge {

/// Row m lists the bits that are set in m, then zeros.
inline constexpr auto kCompressTable = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < table.size(); ++mask) {
    std::size_t next = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit)
      if (mask >> bit & 1) table[mask][next++] = bit;
  }
  return table;
}();

}  // namespace impinge
