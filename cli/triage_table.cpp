// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/text.hpp"
#include "report/units.hpp"
#include "table.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

/// How many pairs of a test have each verdict, "3 penetrating, 2 nearer"; counts those that fail.
std::string counts_of_test(const Review& review, std::uint32_t test, std::uint64_t& failing) {
  std::array<std::uint64_t, 6> counts{};
  for (std::size_t i = 0; i < review.clashes.pairs.size(); ++i) {
    const Clash& pair = review.clashes.pairs[i];
    if (pair.test != test) continue;
    ++counts[static_cast<std::size_t>(pair.verdict)];
    failing += review.standings[i].fails ? 1 : 0;
  }
  std::string text = counts_text(counts, "nearer");
  return text.empty() ? "nothing" : text;
}

std::string summary_of_test(const Review& review, std::uint32_t test) {
  const PlannedTest& planned = review.plan.tests()[test];
  const std::string unit = unit_after(review.assembly.unit_in_metres);
  std::uint64_t failing = 0;
  const std::string counts = counts_of_test(review, test, failing);
  std::string left_out;
  for (const auto& [rule, pairs] : review.plan.left_out(test))
    left_out +=
        fmt::format("{}{} by '{}'", left_out.empty() ? "; left out by design: " : ", ", counted(pairs, "pair"), rule);
  return fmt::format("{}: {}{} of {} {}, tolerance {}: {}; {}{}.\n", printable(planned.name), name(planned.mode),
                     planned.clearance > 0 ? fmt::format(" {}{}", planned.clearance, unit) : "",
                     counted(planned.parts_a, "part"),
                     planned.b.empty() ? "against each other" : "against " + counted(planned.parts_b, "part"),
                     planned.tolerance ? fmt::format("{}{}", *planned.tolerance, unit) : "auto", counts,
                     failing == 0   ? "none fails"
                     : failing == 1 ? "1 fails"
                                    : grouped(failing) + " fail",
                     left_out);
}

std::string summary_of_changes(const Review& review, const std::string& previous) {
  std::uint64_t fresh = 0, changed = 0, persisting = 0, worse = 0;
  for (std::size_t i = 0; i < review.standings.size(); ++i) {
    const Standing& standing = review.standings[i];
    ++(standing.change == Change::fresh ? fresh : has_new_region(standing) ? changed : persisting);
    worse += standing.change != Change::fresh && is_worse(review.clashes.pairs[i], standing) ? 1 : 0;
  }
  return fmt::format("Since {}: {} new, {} with a new region, {} persisting, {} resolved{}.\n", printable(previous),
                     grouped(fresh), grouped(changed), grouped(persisting), grouped(review.resolved.size()),
                     worse > 0 ? fmt::format("; {} worse than before", grouped(worse)) : "");
}

std::string name_of(const Review& review, GroupBy by, std::uint32_t number) {
  if (by == GroupBy::part) return review.assembly.labels[number];
  if (by == GroupBy::test) return printable(review.plan.tests()[number].name);
  return printable(review.types.types[number].name);
}

}  // namespace

void print_groups(const Review& review, GroupBy by, const std::vector<std::size_t>& order, std::uint64_t shown,
                  Sink& sink, std::optional<std::size_t> width, const std::stop_token& stop) {
  const std::vector<PairGroup> groups = groups_of(by, review.clashes.pairs, order, review.types);
  const bool by_type = by == GroupBy::type;
  const auto worst = [&](std::size_t row) {
    return std::string(impinge::name(review.clashes.pairs[groups[row].pairs.front()].verdict));
  };
  const auto failing = [&](std::size_t row) {
    return grouped(static_cast<std::uint64_t>(std::ranges::count_if(
        groups[row].pairs, [&](std::size_t pair) { return bool(review.standings[pair].fails); })));
  };
  using enum Column::Kind;
  Table table{static_cast<std::size_t>(std::min<std::uint64_t>(groups.size(), shown)),
              {{"worst", text, worst},
               {"pairs", number, [&](std::size_t row) { return grouped(groups[row].pairs.size()); }},
               {"fail", number, failing},
               {by == GroupBy::test ? "test"
                : by_type           ? "type"
                                    : "part",
                name, [&](std::size_t row) { return name_of(review, by, groups[row].a); }}}};
  if (by_type)
    table.columns.push_back({"type", name, [&](std::size_t row) { return name_of(review, by, *groups[row].b); }});
  if (table.rows > 0) print(table, sink, width, stop);
  if (table.rows < groups.size())
    sink.write(fmt::format("({} of {}, by --limit; --json has them all.)\n", grouped(table.rows),
                           counted(groups.size(), "group")));
  if (!groups.empty()) sink.write("\n");
}

std::string triage_summary(const Review& review, const ClashArguments& arguments) {
  std::string text;
  for (std::uint32_t i = 0; i < review.plan.tests().size(); ++i) text += summary_of_test(review, i);
  if (arguments.previous) text += summary_of_changes(review, *arguments.previous);
  return text;
}

}  // namespace impinge::cli
