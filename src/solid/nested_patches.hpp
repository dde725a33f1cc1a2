// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "solid/body.hpp"
#include "solid/orientation.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// Per patch, the first of the outermost closed patches within which it lies; itself if there is none, or if it is not
/// closed. A patch lies within another if the other winds around some of its vertices, and around or through all,
/// exactly.
std::vector<std::uint32_t> outermost_patches(const Body& body, const Topology& topology, const Orientation& orientation,
                                             const std::stop_token& stop);

}  // namespace impinge::solid
