// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <map>
#include <set>
#include <utility>

#include "report/text.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

/// What parts are counted by; the values are those that the page's matrix has.
constexpr std::array<std::string_view, 3> kTraits{"file", "class", "storey"};

struct Count {
  std::uint64_t pairs = 0, failing = 0;
};

}  // namespace

Result<void> write_matrix(Sink& sink, const Review& review) {
  sink.write("by,a,b,pairs,fail\r\n");
  for (const std::string_view trait : kTraits) {
    if (review.options.stop.stop_requested()) return interrupted();
    const Assembly& assembly = review.assembly;
    std::vector<std::string_view> values;
    for (std::size_t i = 0; i < assembly.objects.size(); ++i)
      values.push_back(trait == "file" ? assembly.files[assembly.file_of[i]] : property_of(assembly.objects[i], trait));
    if (std::set(values.begin(), values.end()).size() < 2) continue;
    std::map<std::pair<std::string_view, std::string_view>, Count> counts;
    for (std::size_t i = 0; i < review.clashes.pairs.size(); ++i) {
      const auto& [a, b] = review.clashes.pairs[i].objects;
      Count& count = counts[std::minmax<std::string_view>(values[a], values[b])];
      ++count.pairs;
      count.failing += review.standings[i].fails ? 1 : 0;
    }
    for (const auto& [key, count] : counts)
      sink.write(fmt::format("{},{},{},{},{}\r\n", trait, csv_cell(key.first), csv_cell(key.second), count.pairs,
                             count.failing));
  }
  for (const std::string& file : review.assembly.skipped) sink.write(fmt::format("skipped,{},,,\r\n", csv_cell(file)));
  return {};
}

}  // namespace impinge::report
