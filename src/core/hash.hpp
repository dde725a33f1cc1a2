// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

namespace impinge {

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014): a bijection that mixes all bits. docs/hash.md tells users how
/// to recompute the hash of an answer from it.
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// Folds one more word into a running hash.
inline std::uint64_t mix(std::uint64_t hash, std::uint64_t word) { return mix(hash ^ mix(word)); }

/// The bits of a number, -0 taken as +0.
inline std::uint64_t number_bits(double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); }

}  // namespace impinge
