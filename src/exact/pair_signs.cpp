// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "exact/pair_signs.hpp"

#include <array>
#include <bit>

namespace impinge::exact {
namespace {

/// What the nine bits of PairSigns::kShared mean.
struct Sharing {
  enum How : std::uint8_t {
    not_at_all,
    with_repeats,  ///< some vertex stands twice in a triangle
    properly,      ///< one corner each with one
  } how;
  std::uint8_t a_next, b_next;  ///< the corners after one that is shared
};

constexpr auto kSharings = [] {
  std::array<Sharing, 512> sharings{};
  for (unsigned bits = 1; bits < 512; ++bits) {
    unsigned of_a = 0, of_b = 0;
    Sharing& sharing = sharings[bits];
    for (unsigned i = 0; i < 9; ++i) {
      if ((bits >> i & 1) == 0) continue;
      sharing.a_next = static_cast<std::uint8_t>((i / 3 + 1) % 3),
      sharing.b_next = static_cast<std::uint8_t>((i + 1) % 3);
      of_a |= 1U << i / 3, of_b |= 1U << i % 3;
    }
    const bool one_to_one = std::popcount(of_a) == std::popcount(bits) && std::popcount(of_b) == std::popcount(bits);
    sharing.how = one_to_one ? Sharing::properly : Sharing::with_repeats;
  }
  return sharings;
}();

/// In the table below alone: a shared vertex and both straddling.
constexpr auto kAtVertex = static_cast<Outcome>(static_cast<int>(Outcome::open) + 1);

constexpr Outcome outcome_by_position(Position a, Position b, Sharing::How sharing, bool both_proper) {
  if (a == Position::beyond || b == Position::beyond) return Outcome::apart;
  if (sharing == Sharing::not_at_all) return Outcome::open;
  if (sharing == Sharing::with_repeats) return Outcome::touching;  // one of them has no area
  // Strictly on one side but for the contact: whatever else the two are, their interiors do not meet.
  if (a == Position::touching || b == Position::touching) return Outcome::touching;
  if (a == Position::inside || b == Position::inside) return both_proper ? Outcome::coplanar : Outcome::open;
  return a == Position::straddling && b == Position::straddling ? kAtVertex : Outcome::open;
}

/// By positions, sharing, and the four bits of the normals.
constexpr auto kOutcomes = [] {
  std::array<std::array<std::array<std::array<Outcome, 16>, 3>, 5>, 5> outcomes{};
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < 5; ++b)
      for (std::size_t sharing = 0; sharing < 3; ++sharing)
        for (std::size_t normals = 0; normals < 16; ++normals)
          outcomes[a][b][sharing][normals] =
              outcome_by_position(static_cast<Position>(a), static_cast<Position>(b),
                                  static_cast<Sharing::How>(sharing), normals % 4 != 0 && normals / 4 != 0);
  return outcomes;
}();

/// Both straddle the other's plane and share a vertex v, so that the common line runs from v into both triangles. With
/// normals m of a and n of b, a = (v, p, q) and v as the origin, the line leaves v within a along
/// (n . p) q - (n . q) p = n x (q x p) = m x n if p is above b's plane and q below, along n x m the other way round. In
/// the same way it leaves v within b along n x m if b's next corner is above. Interiors meet if the two are one.
Outcome outcome_at_vertex(const PairSigns& signs, const Sharing& sharing) {
  const unsigned a_next_above = signs.above(0) >> sharing.a_next & 1,
                 b_next_above = signs.above(1) >> sharing.b_next & 1;
  return a_next_above != b_next_above ? Outcome::crossing : Outcome::touching;
}

}  // namespace

Outcome outcome_of(PairSigns signs) {
  const Sharing& sharing = kSharings[signs.shared()];
  const auto a = static_cast<std::size_t>(signs.position(0)), b = static_cast<std::size_t>(signs.position(1));
  const Outcome outcome = kOutcomes[a][b][sharing.how][signs.get(PairSigns::kNormal, 4)];
  return outcome == kAtVertex ? outcome_at_vertex(signs, sharing) : outcome;
}

}  // namespace impinge::exact
