// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/mesh_data.hpp"
#include "exact/contact.hpp"
#include "impinge/contacts.hpp"

namespace impinge::exact {

/// Decides pairs of triangles of two placed meshes, many at a time, and appends those that share a point, with their
/// kinds, in the order of the pairs.
void settle(const MeshData& mesh_a, const Pose& pose_a, const MeshData& mesh_b, const Pose& pose_b,
            std::span<const TrianglePair> pairs, std::vector<Contact>& contacts);

/// The same one by one, also of world coordinates that are no multiples of 2^-358.
void settle_one_by_one(const MeshData& mesh_a, const Pose& pose_a, const MeshData& mesh_b, const Pose& pose_b,
                       std::span<const TrianglePair> pairs, std::vector<Contact>& contacts);

}  // namespace impinge::exact
