// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace impinge::partition {

/// Pairs of triangles for the narrow phase, an array a coordinate. Both triangles of a pair are given in one frame,
/// into which an affine map takes the world; which frame that is may differ from pair to pair.
struct PairStream {
  static constexpr std::size_t kCapacity = 512;
  /// Rows are this far apart: not by a power of two, for which they would share few lines of a cache.
  static constexpr std::size_t kStride = kCapacity + 16;

  /// x, y, z of the first vertex, then of the second and the third.
  alignas(64) float a[9][kStride];
  alignas(64) float b[9][kStride];
  alignas(64) float error[kStride];                        ///< each coordinate is within this of the exact one's
  alignas(64) std::uint32_t id_a[kStride], id_b[kStride];  ///< mesh triangle ids
  /// Of two triangles of one mesh with one or two vertices in common: a bit for each of A's corners that is one of
  /// these, and three more for B's. Else 0. Read only where asked for.
  alignas(64) std::uint32_t common[kStride];
  std::size_t size = 0;
};

}  // namespace impinge::partition
