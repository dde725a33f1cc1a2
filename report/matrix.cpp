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

/// The first value of an IFC property, or empty.
std::string value_of(const Review& review, std::uint32_t object, std::string_view trait) {
  const Assembly& assembly = review.assembly;
  if (trait == "file") return assembly.files[assembly.file_of[object]];
  for (const auto& [name, value] : assembly.objects[object].properties)
    if (name == trait) return value;
  return {};
}

struct Count {
  std::uint64_t pairs = 0, failing = 0;
};

}  // namespace

Result<void> write_matrix(Sink& sink, const Review& review) {
  sink.write("by,a,b,pairs,fail\r\n");
  for (const std::string_view trait : kTraits) {
    if (review.options.stop.stop_requested()) return interrupted();
    std::vector<std::string> values;
    for (std::uint32_t i = 0; i < review.assembly.objects.size(); ++i) values.push_back(value_of(review, i, trait));
    if (std::set<std::string_view>(values.begin(), values.end()).size() < 2) continue;
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
