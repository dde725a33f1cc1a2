// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <stop_token>

#include "clash/regions/shared_parts.hpp"
#include "impinge/regions.hpp"
#include "solid/part.hpp"

namespace impinge::clash {

/// Measures the region of the contacts with the indices `members`. Lines no farther apart than `within` are one; with
/// 0, than rounding makes.
Region measured(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                const SharedParts& parts, std::span<const std::uint32_t> members, double within = 0,
                const std::stop_token& stop = {});

}  // namespace impinge::clash
