// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impinge/options.hpp"
#include "scenes/random.hpp"
#include "tests/oracle/points.hpp"

/// Pairs of triangles that are degenerate, nearly so, or at the borders of what a form of arithmetic can hold, and what
/// is known of them by rationals.
namespace impinge::test {

using Pair = std::array<Triangle, 2>;

struct PairFamily {
  std::string name;
  std::function<Pair(scenes::Random&)> make;
};

std::vector<PairFamily> pair_families();
/// Of a test on a family: its number and its letters.
inline constexpr auto family_name = [](const auto& info) {
  std::string name = std::to_string(info.index);
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
};

/// By rationals.
std::optional<Kind> kind_of(const Pair& pair);
/// Sign of det(b - a, c - a, d - a), by rationals.
int side_of(const Point& a, const Point& b, const Point& c, const Point& d);

/// A pair that meets in the same way: triangles exchanged, their corners in another order, axes exchanged, turned
/// around, and each scaled by a power of two within the domain of contract 1.3. Some zeros are negative.
Pair varied(const Pair& pair, scenes::Random& random);

std::string written(const Pair& pair);

}  // namespace impinge::test
