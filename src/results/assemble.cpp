// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/assemble.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "results/collector.hpp"

namespace impinge::results {
namespace {

/// CONTRACT 8: unordered in the two triangles, summed over contacts, so that neither ids nor order nor swap matter.
std::uint64_t contact_hash(std::uint64_t key_a, std::uint32_t a, std::uint64_t key_b, std::uint32_t b, Kind kind) {
  const std::uint64_t u = mix(key_a, a), v = mix(key_b, b);
  return mix(mix(std::min(u, v), std::max(u, v)), static_cast<std::uint64_t>(kind));
}

}  // namespace

Contacts assemble(std::vector<exact::Contact> contacts, const broad::ObjectPairs& pairs,
                  std::span<const std::uint64_t> keys, const AssembleConfig& config) {
  std::sort(contacts.begin(), contacts.end(), precedes);
  Contacts result;
  result.truncated = config.found > config.limit;
  if (contacts.size() > config.limit) contacts.resize(config.limit);

  result.triangles.reserve(contacts.size());
  result.kinds.reserve(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const exact::Contact& contact = contacts[i];
    const broad::ObjectPair& pair = pairs[contact.object_pair];
    if (i == 0 || contact.object_pair != contacts[i - 1].object_pair) {
      result.objects.push_back({pair.a, pair.b});
      result.offsets.push_back(i);
    }
    result.triangles.push_back({contact.a, contact.b});
    result.kinds.push_back(contact.kind);
    result.offsets.back() = i + 1;
    if (config.with_hash) result.hash += contact_hash(keys[pair.a], contact.a, keys[pair.b], contact.b, contact.kind);
  }
  return result;
}

}  // namespace impinge::results
