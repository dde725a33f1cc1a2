// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "clash/shared_parts.hpp"
#include "impinge/regions.hpp"

namespace impinge::clash {

/// The region made of the contacts that `members` numbers. With a tolerance, lines that come within half of it count
/// as one.
Region measured(const Side& a, const Side& b, std::span<const exact::Contact> contacts, const SharedParts& parts,
                std::span<const std::uint32_t> members, double tolerance = 0);

}  // namespace impinge::clash
