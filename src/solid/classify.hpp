// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>

#include "impinge/clash.hpp"
#include "solid/body.hpp"
#include "solid/topology.hpp"

namespace impinge::solid {

/// What a body is by winding numbers: the best class of its pieces.
struct Classification {
  PartClass best = PartClass::surface;
  std::array<std::uint32_t, 3> pieces{};  ///< how many there are of each class
  std::uint64_t turned = 0;               ///< triangles that were turned to agree with others, or to wind positively
  std::uint64_t unclear_edges = 0;        ///< open edges, of turned triangles, beside which winding is not clear
  std::optional<std::array<std::uint32_t, 2>> unclear_edge{};  ///< the mesh vertices of the first of them
};

/// Once it is stopped, the result is meaningless.
Classification classify(const Body& body, const Topology& topology, const std::stop_token& stop);

/// Keeps the classification of a mesh in its own frame. Safe to use from several threads.
class ClassificationCache {
 public:
  [[nodiscard]] std::optional<Classification> find() const {
    const std::lock_guard lock(mutex_);
    return known_;
  }
  void keep(const Classification& classification) {
    const std::lock_guard lock(mutex_);
    known_ = classification;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<Classification> known_;
};

}  // namespace impinge::solid
