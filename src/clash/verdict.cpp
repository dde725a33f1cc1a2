// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/verdict.hpp"

namespace impinge::clash {
namespace {

using solid::Cells;
using solid::kInside;
using solid::kOtherSide;
using solid::kOutside;
using solid::kSameSide;

/// An open 2-cell of one boundary is in the other's interior, or is shared with both interiors on one side.
bool interiors_meet(const Cells& c) { return ((c.a | c.b) & (kInside | kSameSide)) != 0; }

bool may_be_equal(const Cells& c) { return ((c.a | c.b) & (kInside | kOutside | kOtherSide)) == 0; }

/// No cell of the inner boundary is outside of the outer part, and no cell of the outer boundary inside of the inner
/// part.
bool may_lie_inside(std::uint8_t inner, std::uint8_t outer) {
  return (inner & (kOutside | kOtherSide)) == 0 && (outer & (kInside | kOtherSide)) == 0;
}

Finding of_solids(const Cells& c, bool touch) {
  if (!interiors_meet(c)) return {touch ? Verdict::touching : Verdict::apart};
  if (may_be_equal(c)) return {Verdict::duplicate};
  if (may_lie_inside(c.a, c.b)) return {Verdict::inside, 0};
  if (may_lie_inside(c.b, c.a)) return {Verdict::inside, 1};
  return {Verdict::penetrating};
}

/// `cells` are those of the surface in the solid.
Finding of_surface_and_solid(std::uint8_t cells, bool touch, int surface) {
  if ((cells & kInside) == 0) return {touch ? Verdict::touching : Verdict::apart};
  if ((cells & kOutside) != 0) return {Verdict::crossing};
  return {Verdict::inside, surface};
}

}  // namespace

Finding verdict_of(const Cells& cells, const Kinds& kinds, bool touch, bool pass) {
  if (kinds.a_is_solid && kinds.b_is_solid) return of_solids(cells, touch);
  if (kinds.b_is_solid) return of_surface_and_solid(cells.a, touch, 0);
  if (kinds.a_is_solid) return of_surface_and_solid(cells.b, touch, 1);
  if (touch && may_be_equal(cells) && (cells.a & cells.b & kSameSide) != 0) return {Verdict::duplicate};
  return {!touch ? Verdict::apart : pass ? Verdict::crossing : Verdict::touching};
}

// Bits are only ever added, and a bit rules out each of the three verdicts before `penetrating` for good.
bool is_settled(const Cells& cells, const Kinds& kinds) {
  if (kinds.a_is_solid || kinds.b_is_solid) {
    const Verdict verdict = verdict_of(cells, kinds, false, false).verdict;
    return verdict == Verdict::penetrating || verdict == Verdict::crossing;
  }
  return ((cells.a | cells.b) & kOutside) != 0;
}

}  // namespace impinge::clash
