// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/local_frame.hpp"

#include <algorithm>
#include <cmath>

namespace impinge {

double largest_coordinate(const Box& box) { return is_empty(box) ? 0 : max_component(max(abs(box.lo), abs(box.hi))); }

LocalFrame local_frame(const Box& a, const Box& b) {
  const double largest = std::max({largest_coordinate(a), largest_coordinate(b), 0x1p-1000});
  const double unit = std::ldexp(1.0, -std::ilogb(largest));
  const Box& smaller = norm(unit * (a.hi - a.lo)) < norm(unit * (b.hi - b.lo)) ? a : b;
  return {0.5 * smaller.lo + 0.5 * smaller.hi, unit, unit * largest};
}

}  // namespace impinge
