// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "solid/body.hpp"

namespace impinge::clash {

/// Whether two of a body's triangles, of which `kind` says how they meet, make it less than a solid: they cross, or
/// share an area. With a tolerance, a crossing no deeper or no longer than that is the noise of rounded coordinates (a
/// vertex on a face, an edge across an edge) and does no harm.
bool is_defect(const Triangle& a, const Triangle& b, Kind kind, double tolerance);

}  // namespace impinge::clash
