// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/shapes.hpp"
#include "motion/features.hpp"

namespace impinge::motion {

/// A box that moves linearly: what is inside at both ends, and moves linearly, is inside throughout.
struct BoxPath {
  Box from, to;
};

/// Of all triangles, of which there are some.
BoxPath path_of(const Vertices& vertices, std::span<const Corners> triangles);

/// Larger by half of a distance and of its tolerance (`approach.hpp`) on all sides, or a little more: what comes within
/// it of others that are grown as well meets them.
BoxPath grown(const BoxPath& path, double separation);

/// Whether an axis separates two boxes from the start until `end`. The gap along an axis is then a linear function of
/// time, positive throughout if it is at both ends.
bool stay_apart(const BoxPath& a, const BoxPath& b, double end);

}  // namespace impinge::motion
