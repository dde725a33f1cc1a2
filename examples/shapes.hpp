// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <type_traits>
#include <utility>
#include <vector>

#include "impinge/impinge.hpp"

/// The value of a result; where there is none, says why and ends the program.
template <class T>
T value_of(impinge::Result<T> result) {
  if (!result.has_value()) {
    std::cerr << result.error().message << '\n';
    std::exit(1);
  }
  if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

/// A box by its lowest and its highest corner, its normals outwards.
inline impinge::Mesh box(const impinge::Point& a, const impinge::Point& b) {
  const std::vector<double> corners{a.x, a.y, a.z, b.x, a.y, a.z, b.x, b.y, a.z, a.x, b.y, a.z,   // below
                                    a.x, a.y, b.z, b.x, a.y, b.z, b.x, b.y, b.z, a.x, b.y, b.z};  // above
  const std::vector<std::uint32_t> triangles{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                             1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  return value_of(impinge::Mesh::create(corners, triangles));
}
