// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "results/contact_key.hpp"

namespace impinge::results {

/// Contract 2.6 (docs/hash.md): unordered in the two triangles, summed over contacts, so that neither ids nor order nor
/// swap matter. The keys are those of the row's objects.
std::uint64_t row_hash(std::span<const ContactKey> row, std::uint64_t key_a, std::uint64_t key_b);

}  // namespace impinge::results
