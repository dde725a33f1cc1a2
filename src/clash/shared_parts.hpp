// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "clash/regions.hpp"
#include "clash/shared_part.hpp"

namespace impinge::clash {

/// What each of many pairs shares, in compressed rows.
struct SharedParts {
  std::vector<std::size_t> offsets;
  std::vector<Corner> corners;

  [[nodiscard]] std::span<const Corner> operator[](std::size_t contact) const {
    return {corners.data() + offsets[contact], offsets[contact + 1] - offsets[contact]};
  }
};

/// Incomplete if stopped.
SharedParts shared_parts(const Side& a, const Side& b, std::span<const exact::Contact> contacts,
                         const ForEach& for_each, const std::stop_token& stop);

}  // namespace impinge::clash
