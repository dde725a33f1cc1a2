// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "impinge/result.hpp"

namespace impinge {

/// A point of space, in the caller's unit of length.
struct Point {
  double x, y, z;
  friend bool operator==(const Point&, const Point&) = default;
};
using Segment = std::array<Point, 2>;
using Triangle = std::array<Point, 3>;

/// Any affine map x -> m x + t. `m` is row-major.
struct Affine {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> t{};
};

/// Of any length but 0; w is the real part.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};

/// Where an object stands: x -> R x + t, computed as ((R00*x + R01*y) + R02*z) + t0 and so on, every
/// product and sum rounded once to double, never fused. `R` is row-major, finite, with a positive determinant and
/// max|RᵀR - I| <= 1e-6; bake anything else into the mesh with `Mesh::transformed`.
struct Pose {
  std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> t{};

  /// The rotation of the quaternion, whatever its length, and then t. Errors: `bad_pose` (a number that is not finite,
  /// or a quaternion of length 0).
  static Result<Pose> from_quaternion(const Quaternion& rotation, const std::array<double, 3>& t = {});
  /// The rotation nearest to a matrix that was one before it was rounded, by the sum of squares of what its entries
  /// are off (the orthogonal factor of the polar decomposition), and the map's t. Errors: `bad_pose` (a number that is
  /// not finite; max|RᵀR - I| above 0.1, which is a scale or a shear; a mirror image).
  static Result<Pose> nearest(const Affine& map);
};

/// Settings of a mesh's bounding-volume tree. They change the speed of a query, never its answer.
struct TreeConfig {
  std::uint32_t leaf_size = 0;  ///< most triangles in a leaf, 1 to 256; 0: what each backend does best with
};

/// What the coordinates of a mesh went through: it says how far they may be off (`ClashOptions::tolerance`).
enum class Precision : std::uint8_t { whole, single };

struct MeshData;   // internal
struct MeshState;  // internal

/// An immutable triangle mesh with its lazily built tree. A handle: copies are cheap and share both.
/// Safe to use from many threads. A mesh that was moved from may only be destroyed or assigned to.
class Mesh {
 public:
  /// `xyz` holds 3 finite coordinates a vertex, `triangles` 3 vertex indices a triangle. Degenerate and duplicate
  /// triangles are kept and count; a mesh without triangles touches nothing.
  /// Errors: `bad_mesh` (not a multiple of three, not finite, index out of range, more than 2^31 - 1 triangles),
  /// `bad_option` (leaf size).
  static Result<Mesh> create(std::span<const double> xyz, std::span<const std::uint32_t> triangles,
                             const TreeConfig& tree = {}, Precision precision = Precision::whole);
  static Result<Mesh> create(std::span<const float> xyz, std::span<const std::uint32_t> triangles,
                             const TreeConfig& tree = {});

  /// The mesh with every vertex mapped by the formula of a pose, so the answer is the same bit for bit as if the
  /// map had been a pose. Mirroring keeps the order of vertices and triangles.
  /// Errors: `bad_pose` (map not finite), `out_of_range` (a vertex is mapped to infinity).
  Result<Mesh> transformed(const Affine& map) const;

  /// The same triangles with other vertices: `xyz` holds 3 finite coordinates for each vertex. Every answer is that of
  /// a mesh created from these numbers. Where a third of this mesh's tree is made, by queries or `build_tree`, the rest
  /// is made once, and queries refit what they reach of it, but for parts that have become loose; else they make a tree
  /// as the backends "paper" and "raster" always do. A mesh that was refitted itself passes on what it was refitted by,
  /// however little of its tree is made, unless more than an eighth of it had become loose. Errors: `bad_mesh` (not as
  /// many coordinates, not finite).
  Result<Mesh> deformed(std::span<const double> xyz) const;

  [[nodiscard]] std::size_t vertex_count() const noexcept;
  [[nodiscard]] std::size_t triangle_count() const noexcept;
  [[nodiscard]] std::span<const Point> vertices() const noexcept;
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> triangles() const noexcept;
  [[nodiscard]] Precision precision() const noexcept;
  /// The edges of its triangles: (larger, smaller) vertex, ascending, each once. A triangle's equal corners have none.
  /// Found when first asked for, so that memory may run out (`std::bad_alloc`).
  [[nodiscard]] std::span<const std::array<std::uint32_t, 2>> edges() const;
  /// Bounding sphere in the mesh's own frame: the smallest one, up to rounding. {0, 0, 0} and 0 without vertices in
  /// use.
  [[nodiscard]] Point sphere_center() const noexcept;
  [[nodiscard]] double sphere_radius() const noexcept;

  /// Makes the whole tree now, on up to `threads` threads (0: all there are). Without it queries make what they need of
  /// it. Errors: `bad_option` (a negative number).
  [[nodiscard]] Result<void> build_tree(int threads = 0) const;
  /// What the mesh holds in memory now, beyond its vertices and triangles: the part of its tree that is made, and what
  /// `self_collide` keeps of its vertices. What meshes deformed from each other share counts in each. Its pieces, edges
  /// and features do not count.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Internal: what the stages work on.
  [[nodiscard]] const MeshState& state() const noexcept { return *state_; }

 private:
  static Result<Mesh> make(Result<MeshData> numbers, const TreeConfig& config);
  explicit Mesh(std::shared_ptr<const MeshState> state) : state_(std::move(state)) {}
  std::shared_ptr<const MeshState> state_;
};

/// The world vertex that every answer is exact on: the formula of `Pose`.
Point world_vertex(const Pose& pose, const Point& vertex);

}  // namespace impinge
