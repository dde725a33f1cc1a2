// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <hwy/contrib/sort/vqsort.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "broad/object_pairs.hpp"
#include "core/for_each.hpp"
#include "impinge/contacts.hpp"
#include "results/collector.hpp"

namespace impinge::results {

struct AssembleConfig {
  std::uint64_t limit;
  bool with_hash;
  bool all_rows;  ///< a row for every pair of objects, touching or not
  ForEach for_each{};
};

/// Memory that may be kept between calls.
struct AssembleScratch {
  std::vector<std::size_t> row_ends;
  std::vector<ContactKey> keys, dealt;
  std::vector<std::uint64_t> hashes;
  hwy::Sorter sorter;
};

/// An object's hash key.
using KeyOf = std::function<std::uint64_t(std::uint32_t object)>;

/// Contacts in any order become rows in canonical order, cut at the limit, and their hash. `result` is written over,
/// but for its statistics; its memory is used again.
void assemble(std::span<const Collector* const> collectors, const broad::ObjectPairs& pairs, const KeyOf& key_of,
              const AssembleConfig& config, AssembleScratch& scratch, Contacts& result);

}  // namespace impinge::results
