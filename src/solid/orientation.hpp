// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// Which of a body's triangles to turn, so that neighbours agree and closed patches wind positively. A patch is what
/// hangs together across edges that exactly two triangles share.
struct Orientation {
  std::vector<std::uint32_t> patch;  ///< per triangle; kNoPatch for those left out
  std::vector<bool> is_turned;       ///< per triangle
  std::vector<bool> is_closed;       ///< per patch: its triangles alone run through each edge as often either way
  /// Per patch: the outermost closed patch within which it lies, itself if there is none, or if it is not closed.
  std::vector<std::uint32_t> outermost;

  static constexpr std::uint32_t kNoPatch = 0xffffffff;
};

/// Neighbours in a patch are turned to agree: the larger area keeps its side, of equals the first triangle's; a patch
/// where that is impossible stays as it is. Then each outermost closed patch that winds negatively is turned, together
/// with all closed patches within it. Triangles in `left_out` count nowhere. Once it is stopped, the result is
/// meaningless.
Orientation orient(const Body& body, const Topology& topology, const std::vector<bool>& left_out,
                   const std::stop_token& stop);

}  // namespace impinge::solid
