// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/for_each.hpp"
#include "core/mesh_data.hpp"

namespace impinge::partition {

/// The vertices whose stars (the triangles that have them) are certainly embedded: projected along some direction, the
/// triangles go round the vertex once. Two of them share nothing but a common edge or the vertex, so that pairs of
/// triangles with such a vertex in common need no test.
struct EmbeddedStars {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Of each triangle, those of its vertices, kNone in the places of others. Empty: there are none.
  std::vector<std::array<std::uint32_t, 3>> corners;
  double slack = 0;  ///< this holds while each coordinate is off by at most so much
};

/// By vertex, whether each of its edges has as many triangles on one side as on the other, by the orders of their
/// corners: so it is inside of a surface whose triangles are oriented alike.
std::vector<bool> closed_vertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count);

/// Beyond so many vertices or triangles none are looked for.
inline constexpr std::size_t kMostStars = std::size_t{1} << 29;

EmbeddedStars find_embedded_stars(const MeshData& mesh, const std::vector<bool>& closed, const ForEach& for_each = {});

/// What meshes of the same triangles have in common, found when it is first asked for. Safe from many threads.
class ClosedVertices {
 public:
  const std::vector<bool>& of(const MeshData& mesh) {
    std::call_once(once_, [&] { closed_ = closed_vertices(mesh.triangles, mesh.vertices.size()); });
    return closed_;
  }

 private:
  std::once_flag once_;
  std::vector<bool> closed_;
};

/// The embedded stars of one mesh, likewise.
class EmbeddedStarsCache {
 public:
  const EmbeddedStars& of(const MeshData& mesh, ClosedVertices& closed, const ForEach& for_each) {
    std::call_once(once_, [&] { stars_ = find_embedded_stars(mesh, closed.of(mesh), for_each); });
    return stars_;
  }

 private:
  std::once_flag once_;
  EmbeddedStars stars_;
};

}  // namespace impinge::partition
