// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"

/// When moving meshes meet: continuous collision detection, exactly. Vertices move on straight lines, from where one
/// mesh has them at time 0 to where another with the same triangles has them at time 1: (1 - t) x0 + t x1 in real
/// arithmetic.
namespace impinge {

/// Which kinds of features meet. Every other way in which triangles can come to touch is one of these too.
enum class Feature : std::uint8_t {
  vertex_face,  ///< a vertex of the first mesh and a face of the second; or, of a mesh with itself, any of it
  face_vertex,  ///< a face of the first mesh and a vertex of the second
  edge_edge,
};

/// A vertex and a face, or two edges, which share a point at some time, or come within `MotionOptions::separation`.
/// Closed sets: a face has its boundary, an edge its ends; a face or an edge that is degenerate, or becomes so on the
/// way, is then the segment or point that it is.
struct Impact {
  Feature feature;
  std::uint32_t a, b;  ///< a vertex or triangle by its index, an edge by its index in `Mesh::edges`
  Interval time;       ///< holds the first time at which they meet; its ends are equal or neighbouring doubles
  Point point;         ///< where, up to rounding: the vertex, or a point of the first edge
  Point normal;        ///< there, of unit length, up to rounding: of the face, or at right angles to both edges; from b
                       ///< to where a comes from. Of what is apart by a separation, from the point of b that is nearest
                       ///< to a. All zero where there is none
};

struct MotionOptions {
  bool earliest = false;  ///< find only the first impact, and of several with the same `time` the first in order
  double end = 1;         ///< of the time that is looked at, 0 to 1
  /// In the meshes' unit. Above 0 features meet where they come within it: certified, and not exact as at 0. None that
  /// does is missed, and none is found that stays farther apart than it and a tolerance: 2^-10 of it, and 2^-32 of the
  /// largest difference between coordinates of vertices of the two features at either end. Before `Impact::time`, whose
  /// ends are equal then, they are farther apart than the separation, and at that time by no more than the tolerance;
  /// {0, 0} if they are within it at the start, or beyond it by less than 2^-44 of that difference. Of a mesh with
  /// itself, features of triangles that have a vertex in common are tested with 0; others of it are nearer than any
  /// separation that is larger than its triangles.
  double separation = 0;
  /// Of a mesh with itself: features that share a vertex always meet, and are not reported. Of vertices or edges that
  /// are the same by position, the lowest index stands for all.
  Adjacency adjacency = Adjacency::by_position;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< keep the first so many, not with `earliest`
  int threads = 0;                                                  ///< at most so many; 0: all there are
  std::stop_token stop{};
};

struct Impacts {
  std::vector<Impact> impacts;       ///< in order of feature, a, b
  std::optional<Interval> earliest;  ///< the first `time` of all, those beyond the limit too; {0, 0} if and only if
                                     ///< such features meet at the start; an edge through a face is no impact
  bool truncated = false;            ///< more exist than the limit kept
};

/// All impacts between objects: compressed rows, a row a pair of objects that meet.
struct SceneImpacts {
  std::vector<std::array<std::uint32_t, 2>> objects;  ///< per row, in order, the lower object first
  std::vector<std::uint64_t> offsets{0};              ///< rows + 1; row r holds [offsets[r], offsets[r + 1])
  std::vector<Impact> impacts;       ///< in order within a row; `a` is of the row's first object, `b` of its second
  std::optional<Interval> earliest;  ///< as in `Impacts`
  bool truncated = false;            ///< more exist than the limit kept
  std::uint64_t hash = 0;            ///< of the kept impacts (docs/hash.md)
};

/// A mesh at both ends of its way.
struct Moving {
  Mesh from, to;
};

/// All impacts between two meshes, or of a mesh with itself: without a separation none missed, none added. A mesh that
/// is free of self-collision at time 0 and has no impact is free of it throughout (docs/motion.md).
/// Culls by a tree of boxes at both ends: features that an axis separates at both ends by more than the separation, in
/// the same order, never meet.
/// Coordinates may be any finite doubles.
/// Errors: `bad_mesh` (the two ends have different triangles or numbers of vertices), `bad_option`, `cancelled`.
Result<Impacts> find_impacts(const Moving& a, const Moving& b, const MotionOptions& options = {});
Result<Impacts> find_impacts(const Moving& mesh, const MotionOptions& options = {});

/// The part of a motion that leaves everything apart.
struct Step {
  double time = 0;  ///< `MotionOptions::end`, or less where something would meet before that
  /// Each mesh at that time: (1 - time) x0 + time x1, where each operation is rounded to double; coordinates that are
  /// the same at both ends stay.
  std::vector<Mesh> ends;
};

/// How far meshes may go together without meeting each other or themselves. On the way to `ends`, where vertices were
/// rounded to, there is no impact either: a second search says so. Where something would meet, `time` is at least
/// (1 - 2^-10) of the first impact's `Impact::time.lo`, or if rounding would make things meet there, the first of some
/// smaller parts of which it does not; where what meets is nearer than rounding can tell, `ends` may be where they
/// were. What stands still, its vertices the same at both ends, is not tested against itself and what else stands
/// still. `MotionOptions::earliest` and `limit` say nothing here; with a `separation` all stays so far apart. Errors:
/// as `find_impacts`; `in_contact` (something touches at the start, or is within the separation), `out_of_range` (of
/// the start, as `collide`).
Result<Step> collision_free_step(std::span<const Moving> meshes, const MotionOptions& options = {});

}  // namespace impinge
