// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "impinge/options.hpp"

namespace impinge::exact {

/// What is known of two triangles: their `Kind`, that they are apart, or (`open`) neither yet.
enum class Outcome : std::uint8_t { crossing, touching, coplanar, apart, open };
static_assert(static_cast<int>(Outcome::crossing) == static_cast<int>(Kind::crossing) &&
              static_cast<int>(Outcome::touching) == static_cast<int>(Kind::touching) &&
              static_cast<int>(Outcome::coplanar) == static_cast<int>(Kind::coplanar));

/// Of an outcome that is not `open`.
inline std::optional<Kind> kind_of(Outcome outcome) {
  return outcome == Outcome::apart ? std::nullopt : std::optional(static_cast<Kind>(outcome));
}

/// How a triangle lies to the other's plane, as far as the sides of its corners are known. A degenerate triangle has no
/// plane: every corner counts as in it.
enum class Position : std::uint8_t { beyond, straddling, touching, inside, unknown };

namespace detail {
/// From nine bits: those of a triangle's corners above, below and in the plane. Tables, because pairs come in no order
/// that a branch predictor could learn.
inline constexpr auto kPositions = [] {
  std::array<Position, 512> positions{};
  for (unsigned bits = 0; bits < 512; ++bits) {
    const unsigned above = bits & 7, below = bits >> 3 & 7, on = bits >> 6;
    positions[bits] = above == 7 || below == 7    ? Position::beyond
                      : above != 0 && below != 0  ? Position::straddling
                      : (above | below | on) != 7 ? Position::unknown
                      : on == 7                   ? Position::inside
                                                  : Position::touching;
  }
  return positions;
}();
}  // namespace detail

/// What is certain of triangles a and b, as bits. Their vertices are numbered, 0 to 2 a's and 3 to 5 b's; corners of
/// each are numbered from 0.
struct PairSigns {
  /// Sets of three corners: those above the other's plane (on its positive side), below it and in it. b's follow a's.
  static constexpr int kAbove = 0, kBelow = 3, kOn = 6, kSides = 9;
  static constexpr int kShared = 18;  ///< nine bits: 3 i + j says that corner i of a is corner j of b
  static constexpr int kNormal = 27;  ///< two bits each: x, y or z (1, 2, 3) if the normal's is not zero
  static constexpr int kFits = 31;    ///< the coordinates have been made integers

  std::uint64_t bits = 0;

  static constexpr int side_bit(int side, int triangle, int corner) { return side + kSides * triangle + corner; }

  void set(int first, unsigned value) { bits |= std::uint64_t{value} << first; }
  [[nodiscard]] unsigned get(int first, int count) const {
    return static_cast<unsigned>(bits >> first & ((std::uint64_t{1} << count) - 1));
  }
  [[nodiscard]] unsigned above(int triangle) const { return get(kAbove + kSides * triangle, 3); }
  [[nodiscard]] unsigned below(int triangle) const { return get(kBelow + kSides * triangle, 3); }
  [[nodiscard]] unsigned on(int triangle) const { return get(kOn + kSides * triangle, 3); }
  [[nodiscard]] bool knows_sides(int triangle) const { return (above(triangle) | below(triangle) | on(triangle)) == 7; }
  [[nodiscard]] unsigned shared() const { return get(kShared, 9); }
  [[nodiscard]] unsigned normal(int triangle) const { return get(kNormal + 2 * triangle, 2); }
  [[nodiscard]] Position position(int triangle) const { return detail::kPositions[get(kSides * triangle, kSides)]; }
};

/// Of triangles beyond each other's plane, and of those that share vertices: as far as what is known decides.
Outcome outcome_of(PairSigns signs);

}  // namespace impinge::exact
