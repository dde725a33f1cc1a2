// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "impinge/result.hpp"

namespace impinge {

/// The error for world coordinates outside of contract 1.3. `name` says whose they are, such as "object 3".
inline Error out_of_domain(const std::string& name) {
  return {Code::out_of_range,
          name +
              " has world coordinates that are not below 2^300 or not multiples of 2^-358, where answers would not be "
              "exact; scale the scene, or move it nearer to the origin"};
}

}  // namespace impinge
