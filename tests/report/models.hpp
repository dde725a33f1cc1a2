// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scenes/step.hpp"

/// Two solid cubes of 2 m, in millimetres with Z up. The first is from (4, 2, 0) to (6, 4, 2) in metres, the second
/// 1 m over in each direction, so that what they share is the cube of 1 m about (5.5, 3.5, 1.5).
namespace impinge::test {

std::string ifc_of_two_walls();
/// Those of these numbers, 0 and 1, in another unit, of which a metre has so many.
std::string ifc_of_walls(std::span<const std::size_t> numbers, const scenes::StepUnit& unit, double metre);
std::string collada_of_two_walls();

}  // namespace impinge::test
