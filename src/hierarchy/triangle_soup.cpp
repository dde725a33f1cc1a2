// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/triangle_soup.hpp"

#include <algorithm>
#include <array>

namespace impinge::hierarchy {

Vec3 choose_base(const SoupSource& source, std::size_t count, const std::function<std::uint32_t(std::size_t)>& id_of) {
  constexpr std::size_t kSample = 64;
  const std::size_t size = std::min(kSample, count);
  std::array<std::array<double, kSample>, 3> coordinates{};
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 v = source.corner(id_of(i * count / size), 0);
    coordinates[0][i] = v.x, coordinates[1][i] = v.y, coordinates[2][i] = v.z;
  }
  const auto median = [&](std::array<double, kSample>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(size / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(size));
    return *middle;
  };
  return {median(coordinates[0]), median(coordinates[1]), median(coordinates[2])};
}

void write_corners(const SoupSource& source, const Vec3& base, std::span<SoupTriangle> triangles) {
  for (SoupTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 v = source.corner(triangle.id, i) - base;
      triangle.corner[3 * i] = static_cast<float>(v.x);
      triangle.corner[3 * i + 1] = static_cast<float>(v.y);
      triangle.corner[3 * i + 2] = static_cast<float>(v.z);
    }
  }
}

}  // namespace impinge::hierarchy
