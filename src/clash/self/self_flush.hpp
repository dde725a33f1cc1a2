// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "impinge/contacts.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::clash {

/// Pairs of a closed body's own triangles that share an area within the tolerance: flush over more than 16 tolerances
/// in every direction. What is narrower is the noise of rounded coordinates. Triangles with nothing between them but a
/// gap are flush up to the tolerance; where there may be a thin wall between them, up to an eighth of it, which is what
/// rounding does. Of the tolerance no more counts than a 256th of the body's wall. In order; not all if stopped.
/// Nothing where the tolerance is too small for floating point: then only what is exact can be told.
std::optional<std::vector<TrianglePair>> self_flush(const solid::Body& body, const solid::Topology& topology,
                                                    double tolerance, const std::stop_token& stop = {});

}  // namespace impinge::clash
