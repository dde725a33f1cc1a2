// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <stop_token>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"

namespace impinge {

/// Every pair of triangles of `mesh_a` at `pose_a` and of `mesh_b` at `pose_b` that share a point, exactly, on the
/// world vertices of `Pose`. Object 0 is a, object 1 is b; there is at most one row. Safe to call from many threads.
/// Errors: `bad_pose`, `out_of_range` (a world coordinate is not below 2^300, or the mesh's largest is neither 0 nor at
/// least 2^-300), `bad_option`, `cancelled`.
Result<Contacts> collide(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                         const Options& options = {}, Workspace* workspace = nullptr);

/// Whether any triangle of `mesh_a` at `pose_a` and any of `mesh_b` at `pose_b` share a point: whether `collide` would
/// have a row, found on the calling thread alone, by backend "simd". The search stops at the first pair. The cheapest
/// call for one pair: where their bounds are apart it allocates nothing and costs some tens of nanoseconds. Safe to
/// call from many threads. Errors: as `collide`.
Result<bool> touches(const Mesh& mesh_a, const Pose& pose_a, const Mesh& mesh_b, const Pose& pose_b,
                     const std::stop_token& stop = {}, Workspace* workspace = nullptr);

/// Every pair of triangles i < j of one placed mesh that share a point outside of the convex hull of the vertices which
/// they have in common (`Options::adjacency`), or have three in common: neighbours are reported where they go through
/// each other or are folded flat onto each other, and not for being neighbours. Kinds, order, limit and hash are as for
/// two meshes; the one row is of objects 0 and 0. Safe to call from many threads. Errors: as `collide`.
Result<Contacts> self_collide(const Mesh& mesh, const Pose& pose = {}, const Options& options = {},
                              Workspace* workspace = nullptr);

/// `collide` for many poses in one call: row k is about pose k of either mesh, where one pose alone goes with all of
/// the other mesh's. Every pose has its row, touching or not, so that `offsets` may be indexed by pose; `objects[k]`
/// holds the indices of its two poses. `Find::first`, `limit` and `threads` go for the call as a whole. Errors: as
/// `collide`, and `bad_option` if the numbers of poses do not match.
Result<Contacts> collide_poses(const Mesh& mesh_a, std::span<const Pose> poses_a, const Mesh& mesh_b,
                               std::span<const Pose> poses_b, const Options& options = {},
                               Workspace* workspace = nullptr);

}  // namespace impinge
