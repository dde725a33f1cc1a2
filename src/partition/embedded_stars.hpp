// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <new>
#include <span>
#include <stop_token>
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
/// corners: so it is inside of a surface whose triangles are oriented alike. Empty if no vertex is. Throws `Stopped`.
std::vector<bool> closed_vertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count,
                                  const std::stop_token& stop = {});

/// Beyond so many vertices or triangles none are looked for.
inline constexpr std::size_t kMostStars = std::size_t{1} << 29;

/// False where the mesh has too many vertices or triangles, or coordinates beyond those that the bounds are for.
bool may_have_embedded_stars(const MeshData& mesh);

/// `closed`: as by `closed_vertices`. Throws `Stopped`.
EmbeddedStars find_embedded_stars(const MeshData& mesh, const std::vector<bool>& closed, const ForEach& for_each = {},
                                  const std::stop_token& stop = {});

/// What meshes of the same triangles have in common, found when it is first asked for. Safe from many threads. After
/// `Stopped` the next query begins anew.
class ClosedVertices {
 public:
  const std::vector<bool>& of(const MeshData& mesh, const std::stop_token& stop) {
    std::call_once(once_, [&] {
      closed_ = closed_vertices(mesh.triangles, mesh.vertices.size(), stop);
      bytes_ = closed_.capacity() / 8;
    });
    return closed_;
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::once_flag once_;
  std::vector<bool> closed_;
  std::atomic<std::size_t> bytes_{0};
};

/// The embedded stars of one mesh, likewise. None where memory runs out: queries need no stars.
class EmbeddedStarsCache {
 public:
  const EmbeddedStars& of(const MeshData& mesh, ClosedVertices& closed, const ForEach& for_each,
                          const std::stop_token& stop) {
    std::call_once(once_, [&] {
      try {
        if (may_have_embedded_stars(mesh)) stars_ = find_embedded_stars(mesh, closed.of(mesh, stop), for_each, stop);
      } catch (const std::bad_alloc&) {
      }
      known_.store(&stars_, std::memory_order_release);
    });
    return stars_;
  }
  /// Null: they were not asked for yet.
  [[nodiscard]] const EmbeddedStars* known() const { return known_.load(std::memory_order_acquire); }
  [[nodiscard]] std::size_t bytes() const {
    const EmbeddedStars* const stars = known();
    return stars == nullptr ? 0 : stars->corners.capacity() * sizeof(stars->corners[0]);
  }

 private:
  std::once_flag once_;
  EmbeddedStars stars_;
  std::atomic<const EmbeddedStars*> known_{nullptr};
};

}  // namespace impinge::partition
