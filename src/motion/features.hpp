// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::motion {

using Corners = std::array<std::uint32_t, 3>;

/// The vertices and edges of a mesh by its triangles. Each is in the care of the first triangle that has it, so that
/// pairs of triangles see each pair of features once.
struct Features {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<std::array<std::uint32_t, 2>> edges;  ///< (larger, smaller) vertex, each once; ascending, but for `names`
  std::vector<Corners> corners;                     ///< per triangle
  std::vector<Corners> sides;        ///< per triangle: the edges from each corner to the next; kNone between equal ones
  std::vector<std::uint8_t> care;    ///< per triangle: bit k for corner k, bit 3 + k for side k
  std::vector<std::uint32_t> names;  ///< per edge, ascending, how answers call it; empty: as it stands in `edges`

  explicit Features(std::vector<Corners> triangles);
};

/// The features of a mesh with the lowest of the vertices that are equal at both ends in the place of each; nothing if
/// none are. Of edges that become one, the first names it, and they are in order of that.
std::optional<Features> join_equal_vertices(const Features& of, std::span<const Vec3> from, std::span<const Vec3> to);

/// A mesh's features, found when they are first asked for. Safe from many threads.
class FeaturesCache {
 public:
  const Features& of(std::span<const Corners> triangles) {
    std::call_once(once_, [&] { features_.emplace(std::vector<Corners>(triangles.begin(), triangles.end())); });
    return *features_;
  }

 private:
  std::once_flag once_;
  std::optional<Features> features_;
};

}  // namespace impinge::motion
