// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "clash/regions/shared_parts.hpp"
#include "impinge/regions.hpp"

namespace impinge::clash {

/// The region made of the contacts that `members` numbers. Lines are one where they are no farther apart than
/// `within`; 0: than rounding leaves.
Region measured(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                const SharedParts& parts, std::span<const std::uint32_t> members, double within = 0);

}  // namespace impinge::clash
