// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "results/assemble.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "results/row_hash.hpp"

namespace impinge::results {
namespace {

/// Contacts that one thread takes on at a time.
constexpr std::size_t kPart = std::size_t{1} << 14;

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

/// Sorts a long row on several threads (sample sort): its contacts are dealt to pieces of ascending keys, and each
/// piece is sorted by itself.
void sort_long(std::span<ContactKey> row, const ForEach& for_each, std::vector<ContactKey>& dealt) {
  constexpr std::size_t kPieces = 16, kSamples = 64 * kPieces;
  std::array<ContactKey, kSamples> samples;
  for (std::size_t i = 0; i < kSamples; ++i) samples[i] = row[i * row.size() / kSamples];
  std::sort(samples.begin(), samples.end());
  std::array<ContactKey, kPieces - 1> bounds;
  for (std::size_t p = 1; p < kPieces; ++p) bounds[p - 1] = samples[p * kSamples / kPieces];
  const auto piece_of = [&](ContactKey key) {
    std::size_t piece = 0;
    for (const ContactKey bound : bounds) piece += key >= bound;
    return piece;
  };

  const std::size_t parts = row.size() / kPart + 1;
  const auto part_of_row = [&](std::size_t part) {
    const std::size_t begin = part * row.size() / parts, end = (part + 1) * row.size() / parts;
    return row.subspan(begin, end - begin);
  };
  std::vector<std::array<std::size_t, kPieces>> places(parts);  // how many of a part go to a piece, then where to
  run_each(for_each, parts, [&](std::size_t part) {
    for (const ContactKey key : part_of_row(part)) ++places[part][piece_of(key)];
  });
  std::array<std::size_t, kPieces + 1> begins{};
  std::size_t place = 0;
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    begins[piece] = place;
    for (auto& part : places) place += std::exchange(part[piece], place);
  }
  begins[kPieces] = place;
  dealt.resize(row.size());
  run_each(for_each, parts, [&](std::size_t part) {
    for (const ContactKey key : part_of_row(part)) dealt[places[part][piece_of(key)]++] = key;
  });
  run_each(for_each, kPieces, [&](std::size_t piece) {
    const hwy::Sorter sorter;
    const std::span<ContactKey> keys(dealt.data() + begins[piece], begins[piece + 1] - begins[piece]);
    sort(keys, sorter);
    std::copy(keys.begin(), keys.end(), row.begin() + static_cast<std::ptrdiff_t>(begins[piece]));
  });
}

/// Rows that begin beyond `count` are not kept.
void sort_rows(std::size_t rows, std::size_t count, const ForEach& for_each, AssembleScratch& s) {
  const auto begin_of = [&](std::size_t row) { return row == 0 ? 0 : s.row_ends[row - 1]; };
  const auto first_from = [&](std::size_t contact) {
    if (contact == 0) return std::size_t{0};
    const auto end = s.row_ends.begin() + static_cast<std::ptrdiff_t>(rows);
    return static_cast<std::size_t>(std::lower_bound(s.row_ends.begin(), end, contact) - s.row_ends.begin()) + 1;
  };
  const auto row_of = [&](std::size_t i) {
    return std::span(s.keys).subspan(begin_of(i), s.row_ends[i] - begin_of(i));
  };
  const std::size_t parts = for_each ? count / kPart + 1 : 1, longest = for_each ? 2 * kPart : s.keys.size();
  run_each(for_each, parts, [&](std::size_t part) {
    std::optional<hwy::Sorter> own;
    const hwy::Sorter& sorter = parts == 1 ? s.sorter : own.emplace();
    const std::size_t end = (part + 1) * count / parts;
    for (std::size_t i = first_from(part * count / parts); i < rows && begin_of(i) < end; ++i)
      if (row_of(i).size() <= longest) sort(row_of(i), sorter);
  });
  for (std::size_t i = 0; i < rows && begin_of(i) < count; ++i)
    if (row_of(i).size() > longest) sort_long(row_of(i), for_each, s.dealt);
}

/// Takes the contacts from `begin` to `end` apart and returns the sum of their hashes, if that is asked for.
std::uint64_t write_contacts(std::size_t begin, std::size_t end, const broad::ObjectPairs& pairs, const KeyOf& key_of,
                             bool with_hash, const AssembleScratch& s, Contacts& result) {
  for (std::size_t i = begin; i < end; ++i) {
    result.triangles[i] = {triangle_a(s.keys[i]), triangle_b(s.keys[i])};
    result.kinds[i] = kind_of(s.keys[i]);
  }
  std::uint64_t hash = 0;
  if (!with_hash) return hash;
  auto row_end = std::upper_bound(s.row_ends.begin(), s.row_ends.end(), begin);
  for (; begin < end; ++row_end) {
    const auto& [a, b] = pairs[static_cast<std::size_t>(row_end - s.row_ends.begin())];
    const std::size_t size = std::min(*row_end, end) - begin;
    hash += row_hash(std::span(s.keys).subspan(begin, size), key_of(a), key_of(b));
    begin += size;
  }
  return hash;
}

}  // namespace

void assemble(std::span<const Collector* const> collectors, const broad::ObjectPairs& pairs, const KeyOf& key_of,
              const AssembleConfig& config, AssembleScratch& s, Contacts& result) {
  result.objects.clear();
  result.offsets.assign(1, 0);
  std::uint64_t found = 0;
  for (const Collector* collector : collectors) found += collector->seen();
  result.truncated = found > config.limit;

  group(collectors, pairs.size(), s);
  const std::size_t count = std::min<std::uint64_t>(s.keys.size(), config.limit);
  sort_rows(pairs.size(), count, config.for_each, s);

  result.triangles.resize(count), result.kinds.resize(count);
  const std::size_t parts = config.for_each ? count / kPart + 1 : 1;
  s.hashes.resize(parts);
  run_each(config.for_each, parts, [&](std::size_t part) {
    s.hashes[part] =
        write_contacts(part * count / parts, (part + 1) * count / parts, pairs, key_of, config.with_hash, s, result);
  });
  result.hash = std::accumulate(s.hashes.begin(), s.hashes.end(), std::uint64_t{0});

  for (std::size_t i = 0, begin = 0; i < pairs.size(); begin = s.row_ends[i++]) {
    const std::size_t end = std::min(s.row_ends[i], count);
    if (end <= begin && !config.all_rows) continue;
    result.objects.push_back({pairs[i].a, pairs[i].b});
    result.offsets.push_back(end);
  }
}

}  // namespace impinge::results
