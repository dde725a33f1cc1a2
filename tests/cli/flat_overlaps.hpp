// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scenes/mechanism.hpp"

namespace impinge::test {

/// Two parts of a machine overlap from one time to another; nothing: from the beginning, to the end.
struct Overlap {
  std::size_t a, b;
  std::optional<double> from, to;
};

/// When flat parts overlap within so many seconds, by many steps and halvings, on polygons alone, which boost::geometry
/// intersects.
std::vector<Overlap> overlaps(const std::vector<scenes::FlatPart>& parts, double seconds);

}  // namespace impinge::test
