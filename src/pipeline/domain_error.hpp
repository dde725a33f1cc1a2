// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "impinge/result.hpp"

namespace impinge {

/// The error for world coordinates outside of contract 1.3. `name` says whose they are, such as "object 3".
inline Error out_of_domain(const std::string& name) {
  return {
      Code::out_of_range,
      name +
          " has coordinates where this answer would not be exact: not below 2^300, or too near to 0 (not multiples of "
          "2^-358, or for contacts and distances none of 2^-300 or more); scale the scene, or move it"};
}

}  // namespace impinge
