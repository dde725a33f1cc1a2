// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "clash/regions/regions.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// A part as regions of contact see it, which must outlive this. Each of its shells has a sense of its own: a cavity's
/// normals look into the cavity.
class RegionSide {
 public:
  explicit RegionSide(const solid::Part& part);
  [[nodiscard]] Side side() const;

 private:
  const solid::Part& part_;
  std::vector<std::uint8_t> inward_;
};

}  // namespace impinge::clash
