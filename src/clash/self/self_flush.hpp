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

/// Pairs of a closed body's own triangles that are flush: within the tolerance of each other over an area wider than 16
/// tolerances in every direction; narrower areas are the noise of rounded coordinates. Where there may be a thin wall
/// between the triangles, and not just a gap, an eighth of the tolerance counts, which is more than rounding makes. The
/// tolerance is at most a 256th of the body's wall. In order; incomplete if stopped. Nothing where the tolerance is too
/// small for floating point: then only exact contacts can be found.
std::optional<std::vector<TrianglePair>> self_flush(const solid::Body& body, const solid::Topology& topology,
                                                    double tolerance, const std::stop_token& stop = {});

}  // namespace impinge::clash
