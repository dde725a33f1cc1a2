// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "impinge/result.hpp"

namespace impinge {

/// The error for what is not `in_range` (contract 1.3). `name` says whose the coordinates are, such as "object 3".
inline Error not_in_range(const std::string& name) {
  return {Code::out_of_range,
          name +
              " is out of range: a world coordinate is not below 2^300, or the largest coordinate of a mesh is neither "
              "0 nor at least 2^-300; scale the scene, or move it"};
}

/// The error for what is not `in_exact_domain`, to which verdicts, regions, sweeps, depths and volumes are confined.
inline Error not_in_exact_domain(const std::string& name) {
  return {Code::out_of_range,
          name +
              " has coordinates on which this answer would not be exact: not below 2^300, or not multiples of "
              "2^-358; scale the scene, move it, or round to 0 what is so near to it"};
}

}  // namespace impinge
