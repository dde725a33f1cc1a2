// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/vec3.hpp"

namespace impinge::motion {

using Corners = std::array<std::uint32_t, 3>;

/// The vertices of a mesh at both ends of their ways.
struct Vertices {
  std::span<const Vec3> from, to;
};

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
/// none are. Of edges that become one, the first names it, and they are in order of that. Throws `Stopped`.
std::optional<Features> join_equal_vertices(const Features& of, std::span<const Vec3> from, std::span<const Vec3> to,
                                            const std::stop_token& stop);

/// Which features are of triangles that have a vertex in common: a triangle with the one, a triangle with the other.
class Neighbours {
 public:
  explicit Neighbours(const Features& features);
  [[nodiscard]] bool vertex_and_face(std::uint32_t vertex, std::uint32_t face) const;
  [[nodiscard]] bool edges(std::uint32_t one, std::uint32_t other) const;

 private:
  [[nodiscard]] bool share_corner(std::uint32_t one, std::uint32_t other) const;
  [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::uint32_t vertex) const {
    return std::span(triangles_).subspan(offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]);
  }
  const Features& features_;
  std::vector<std::size_t> offsets_;      ///< per vertex, and the end
  std::vector<std::uint32_t> triangles_;  ///< of each vertex
};

/// Triangles in an order in which each eight of them that follow each other are close, and each eight of such eights,
/// and so on, where the vertices were once.
struct SpatialOrder {
  std::vector<std::uint32_t> triangles;
  double looseness;  ///< the extents of the eights' boxes in those of the triangles' boxes
};

/// What meshes of the same triangles have in common, found when it is first asked for. Safe from many threads.
class FeaturesCache {
 public:
  const Features& of(std::span<const Corners> triangles) {
    std::call_once(once_, [&] { features_.emplace(std::vector<Corners>(triangles.begin(), triangles.end())); });
    return *features_;
  }
  /// The last one that was put; nothing if none was.
  std::shared_ptr<const SpatialOrder> order() {
    const std::scoped_lock lock(mutex_);
    return order_;
  }
  void put(std::shared_ptr<const SpatialOrder> order) {
    const std::scoped_lock lock(mutex_);
    order_ = std::move(order);
  }

 private:
  std::once_flag once_;
  std::optional<Features> features_;
  std::mutex mutex_;
  std::shared_ptr<const SpatialOrder> order_;
};

}  // namespace impinge::motion
