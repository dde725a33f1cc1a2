// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hierarchy/arena.hpp"
#include "hierarchy/refit_plan.hpp"
#include "hierarchy/triangle_soup.hpp"
#include "hierarchy/wide_leaf.hpp"

namespace impinge::hierarchy {

inline constexpr std::uint32_t kMostTriangles = 256;

/// A leaf of at most so many triangles, with axes of its own: computed from the soup's rounded numbers, while the
/// stored coordinates come from the mesh.
const WideLeaf* make_leaf(std::span<const SoupTriangle> triangles, const Vec3& base, const SoupSource& source,
                          Arena& arena);

/// A planned leaf where the source has its vertices now. Its axes have turned with them.
const WideLeaf* refit_leaf(const RefitPlan& plan, const RefitPlan::Leaf& planned, const SoupSource& source,
                           Arena& arena);

}  // namespace impinge::hierarchy
