// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "impinge/options.hpp"

namespace impinge::results {

/// Two triangles of a pair of objects and how they meet, as one number that sorts in canonical order (contract 2.5). A
/// mesh has less than 2^31 triangles, so each takes 31 bits and the kind what is left.
using ContactKey = std::uint64_t;

inline ContactKey contact_key(std::uint32_t a, std::uint32_t b, Kind kind) {
  return std::uint64_t{a} << 33 | std::uint64_t{b} << 2 | static_cast<std::uint64_t>(kind);
}
inline std::uint32_t triangle_a(ContactKey key) { return static_cast<std::uint32_t>(key >> 33); }
inline std::uint32_t triangle_b(ContactKey key) { return static_cast<std::uint32_t>(key >> 2) & 0x7FFFFFFF; }
inline Kind kind_of(ContactKey key) { return static_cast<Kind>(key & 3); }

}  // namespace impinge::results
