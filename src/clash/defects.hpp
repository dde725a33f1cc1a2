// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "impinge/contacts.hpp"

namespace impinge::clash {

/// The pairs of a mesh's own triangles that keep it from being a solid: their number, and the first in order.
struct Defects {
  std::uint64_t count = 0;
  std::optional<TrianglePair> first{};
};

/// Keeps the defects of a mesh in its own frame, which do not depend on its pose, for the last tolerance alone. Safe to
/// use from several threads.
class DefectCache {
 public:
  /// Nothing if another tolerance was the last.
  [[nodiscard]] std::optional<Defects> find(const std::optional<double>& tolerance) const {
    const std::lock_guard lock(mutex_);
    return tolerance == tolerance_ ? defects_ : std::nullopt;
  }
  void keep(const std::optional<double>& tolerance, const Defects& defects) {
    const std::lock_guard lock(mutex_);
    tolerance_ = tolerance, defects_ = defects;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<double> tolerance_;
  std::optional<Defects> defects_;
};

}  // namespace impinge::clash
