// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broad/object_pairs.hpp"
#include "exact/contact.hpp"
#include "impinge/contacts.hpp"

namespace impinge::results {

struct AssembleConfig {
  std::uint64_t limit;
  std::uint64_t found;  ///< contacts in all, with those that collectors dropped beyond the limit
  bool with_hash;
};

/// Contacts in any order become rows in canonical order, cut at the limit, and their hash. `keys` are the objects' hash
/// keys. Leaves `statistics` alone.
Contacts assemble(std::vector<exact::Contact> contacts, const broad::ObjectPairs& pairs,
                  std::span<const std::uint64_t> keys, const AssembleConfig& config);

}  // namespace impinge::results
