// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/assemble.hpp"

#include <algorithm>

#include "core/hash.hpp"

namespace impinge::results {
namespace {

/// CONTRACT 8: unordered in the two triangles, summed over contacts, so that neither ids nor order nor swap matter.
std::uint64_t hash_of(std::span<const ContactKey> row, std::uint64_t key_a, std::uint64_t key_b) {
  const std::uint64_t mixed_kinds[] = {mix(0), mix(1), mix(2)};
  std::uint64_t hash = 0, mixed_a = mix(key_a, 0);
  std::uint32_t previous_a = 0;
  for (const ContactKey contact : row) {
    const std::uint32_t a = triangle_a(contact);
    if (a != previous_a) previous_a = a, mixed_a = mix(key_a, a);
    const std::uint64_t mixed_b = mix(key_b, triangle_b(contact));
    const std::uint64_t both = mix(std::min(mixed_a, mixed_b), std::max(mixed_a, mixed_b));
    hash += mix(both ^ mixed_kinds[static_cast<std::size_t>(kind_of(contact))]);
  }
  return hash;
}

void sort(std::span<ContactKey> keys, const hwy::Sorter& sorter) {
  constexpr std::size_t kFew = 16;
  if (keys.size() <= kFew) return std::sort(keys.begin(), keys.end());
  sorter(keys.data(), keys.size(), hwy::SortAscending());
}

/// Copies each pair's contacts, from all collectors, to one place. row_ends[i] becomes the end of pair i's.
void group(std::span<const Collector* const> collectors, std::size_t pairs, AssembleScratch& s) {
  s.row_ends.assign(pairs + 1, 0);
  for (const Collector* collector : collectors)
    for (const Run& run : collector->runs()) s.row_ends[run.object_pair + 1] += run.count;
  for (std::size_t i = 1; i <= pairs; ++i) s.row_ends[i] += s.row_ends[i - 1];
  s.keys.resize(s.row_ends[pairs]);
  // row_ends[i] is where pair i begins, and moves to its end as its contacts come.
  for (const Collector* collector : collectors) {
    auto next = collector->kept().begin();
    for (const Run& run : collector->runs()) {
      std::copy_n(next, run.count, s.keys.begin() + static_cast<std::ptrdiff_t>(s.row_ends[run.object_pair]));
      s.row_ends[run.object_pair] += run.count;
      next += static_cast<std::ptrdiff_t>(run.count);
    }
  }
}

}  // namespace

void assemble(std::span<const Collector* const> collectors, const broad::ObjectPairs& pairs,
              std::span<const std::uint64_t> keys, const AssembleConfig& config, AssembleScratch& s, Contacts& result) {
  result.objects.clear();
  result.offsets.assign(1, 0);
  result.hash = 0;
  std::uint64_t found = 0;
  for (const Collector* collector : collectors) found += collector->seen();
  result.truncated = found > config.limit;

  group(collectors, pairs.size(), s);
  const std::size_t count = std::min<std::uint64_t>(s.keys.size(), config.limit);
  result.triangles.resize(count), result.kinds.resize(count);
  for (std::size_t i = 0, begin = 0; i < pairs.size(); begin = s.row_ends[i++]) {
    const std::span<ContactKey> row(s.keys.data() + begin, s.row_ends[i] - begin);
    const std::size_t kept = std::min(row.size(), count - std::min(begin, count));
    if (kept == 0 && !config.all_rows) continue;
    sort(row, s.sorter);
    for (std::size_t j = 0; j < kept; ++j) {
      result.triangles[begin + j] = {triangle_a(row[j]), triangle_b(row[j])};
      result.kinds[begin + j] = kind_of(row[j]);
    }
    if (config.with_hash) result.hash += hash_of(row.first(kept), keys[pairs[i].a], keys[pairs[i].b]);
    result.objects.push_back({pairs[i].a, pairs[i].b});
    result.offsets.push_back(std::min(begin, count) + kept);
  }
}

}  // namespace impinge::results
