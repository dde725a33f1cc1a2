// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "impinge/options.hpp"

namespace impinge::exact {

/// Two triangles that share a point.
struct Contact {
  std::uint32_t a, b;
  Kind kind;
};

}  // namespace impinge::exact
