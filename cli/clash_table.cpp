// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "report/text.hpp"
#include "report/tolerance_advice.hpp"
#include "report/units.hpp"
#include "table.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

/// A length with four digits.
std::string length_text(double length) { return fmt::format("{:.4g}", length); }

/// An empty cell. It is not blank, so that nobody takes it for 0 and programs that split lines at spaces find it.
const std::string kNothing = "-";

/// Whether a column marks the pairs that fail: not where `--fail-on` is the default, since then the verdict tells, and
/// not where all pairs fail or none.
bool marks_failing(const Review& review, const ClashArguments& arguments) {
  if (!arguments.config && words_of(arguments.fail_on) == words_of(ClashArguments().fail_on)) return false;
  const std::uint64_t failing = count_failing(review);
  return failing > 0 && failing < review.clashes.pairs.size();
}

/// The columns of the table, whose rows are the pairs in this order.
std::vector<Column> columns_of_pairs(const Review& review, const std::vector<std::size_t>& order,
                                     const ClashArguments& arguments) {
  using enum Column::Kind;
  const std::string unit = in_unit(review.assembly.unit_in_metres);
  const std::vector<Clash>& pairs = review.clashes.pairs;
  std::vector<Column> columns;
  const auto add = [&](std::string heading, Column::Kind kind, auto cell) {
    columns.push_back({std::move(heading), kind, [&, cell](std::size_t row) {
                         return std::string(cell(pairs[order[row]], review.standings[order[row]]));
                       }});
  };
  // "inside  bolt  plate" reads as it is: the bolt lies inside the plate.
  const auto label = [&](std::size_t which) {
    return [&review, which](const Clash& pair, const Standing&) {
      const bool inner_is_second = pair.verdict == Verdict::inside && pair.inner == 1;
      return review.assembly.labels[pair.objects[inner_is_second ? 1 - which : which]];
    };
  };
  add("verdict", text, [](const Clash& pair, const Standing&) { return impinge::name(pair.verdict); });
  add("part", name, label(0));
  add("part", name, label(1));
  if (marks_failing(review, arguments))
    add("fails", text, [](const Clash&, const Standing& standing) { return standing.fails ? "yes" : kNothing; });
  if (review.plan.tests().size() > 1)
    add("test", text, [&review](const Clash& pair, const Standing&) {
      return fit(printable(review.plan.tests()[pair.test].name), 40);
    });
  if (arguments.previous) add("change", text, change_text);
  if (std::ranges::any_of(pairs, [](const Clash& pair) { return pair.overlap_depth.has_value(); }))
    add("depth" + unit, number, [](const Clash& pair, const Standing&) {
      return pair.overlap_depth ? depth_text(*pair.overlap_depth, length_text) : kNothing;
    });
  if (arguments.volumes)
    add("volume", number, [&review](const Clash& pair, const Standing&) {
      return pair.overlap_volume ? volume_text(pair.overlap_volume->volume, review.assembly.unit_in_metres, 4)
                                 : kNothing;
    });
  if (arguments.clearance.value > 0)
    add("distance" + unit, number, [](const Clash& pair, const Standing&) {
      return pair.nearest ? length_text(pair.nearest->distance) : kNothing;
    });
  if (arguments.regions)
    add("regions", number, [](const Clash& pair, const Standing&) { return grouped(pair.regions.size()); });
  const auto is_incomplete = [&](const Clash& pair) { return !incomplete_sides(review, pair).empty(); };
  if (std::ranges::any_of(pairs, is_incomplete))
    add("shape", text, [is_incomplete](const Clash& pair, const Standing&) {
      return is_incomplete(pair) ? std::string("incomplete") : kNothing;
    });
  if (!std::ranges::all_of(review.axes, &std::string::empty))
    columns.push_back({"axes", text, [&](std::size_t row) {
                         const std::string where = fit(printable(axes_text(review, order[row])), 30);
                         return where.empty() ? kNothing : where;
                       }});
  if (std::any_of(pairs.begin(), pairs.end(), [](const Clash& pair) { return pair.note != Note::none; }))
    add("note", text, [](const Clash& pair, const Standing&) { return note_text(pair.note); });
  return columns;
}

void print_pairs(const Review& review, const ClashArguments& arguments, Sink& sink, std::optional<std::size_t> width,
                 const std::stop_token& stop) {
  const std::vector<std::size_t> order = ranked(review.clashes.pairs);
  if (arguments.group_by != GroupBy::none)
    return print_groups(review, arguments.group_by, order, arguments.limit, sink, width, stop);
  const Table table{static_cast<std::size_t>(std::min<std::uint64_t>(order.size(), arguments.limit)),
                    columns_of_pairs(review, order, arguments)};
  if (table.rows > 0) print(table, sink, width, stop);
  if (table.rows < order.size())
    sink.write(fmt::format("({} of {}, by --limit; --json has them all.)\n", grouped(table.rows),
                           counted(order.size(), "pair")));
  if (!order.empty()) sink.write("\n");
}

std::string verdicts_text(const std::vector<Clash>& pairs, double clearance, const std::string& unit) {
  std::array<std::uint64_t, 6> counts{};
  for (const Clash& pair : pairs) ++counts[static_cast<std::size_t>(pair.verdict)];
  std::string text = counts_text(counts, fmt::format("nearer than {}{}", clearance, unit));
  if (!text.empty()) return text;
  return clearance > 0 ? fmt::format("nothing is nearer than {}{}", clearance, unit) : "nothing touches";
}

std::string tolerance_text(const std::vector<Clash>& pairs, const std::optional<double>& asked,
                           const std::string& unit) {
  if (asked) return *asked > 0 ? fmt::format("tolerance {}{}", *asked, unit) : "no tolerance";
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Clash& pair : pairs) {
    least = std::min(least, pair.tolerance);
    most = std::max(most, pair.tolerance);
  }
  if (!(least <= most)) return "tolerance auto";
  const std::string from = fmt::format("{:.2g}", least), to = fmt::format("{:.2g}", most);
  return from == to ? fmt::format("tolerance {}{} (auto)", to, unit)
                    : fmt::format("tolerance {} to {}{} (auto)", from, to, unit);
}

/// Which pairs that overlap have no volume, and why.
std::string volumes_text(const Review& review) {
  std::uint64_t not_solid = 0, refused = 0;
  for (const Clash& pair : review.clashes.pairs) {
    if (pair.overlap_volume || (pair.verdict >= Verdict::touching && pair.note != Note::overlap_within_tolerance))
      continue;
    const bool are_solid = std::ranges::all_of(pair.objects, [&](std::uint32_t object) {
      const auto& pieces = review.parts[object].facts.pieces;
      return pieces[0] > 0 && pieces[1] + pieces[2] == 0;
    });
    ++(are_solid ? refused : not_solid);
  }
  std::string text;
  if (not_solid > 0)
    text += fmt::format("{} without a volume, though they overlap: one of the parts is not solid in all its pieces.\n",
                        counted(not_solid, "pair"));
  if (refused > 0)
    text += fmt::format("{} without a volume, though they overlap: no small shift parts the faces that they share.\n",
                        counted(refused, "pair"));
  return text;
}

std::string summary(const Review& review, const ClashArguments& arguments) {
  const std::vector<Clash>& pairs = review.clashes.pairs;
  const std::string unit = unit_after(review.assembly.unit_in_metres);
  std::array<std::uint64_t, 3> classes{};
  for (const Part& part : review.parts) ++classes[static_cast<std::size_t>(part.facts.part_class)];
  std::string text =
      fmt::format("{}, {}, {}, {}; {}; {}.\n", counted(review.parts.size(), "part"), counted(classes[0], "solid"),
                  counted(classes[1], "cracked solid"), counted(classes[2], "surface"),
                  verdicts_text(pairs, arguments.clearance.value, unit),
                  review.plan.tests().empty() ? tolerance_text(pairs, value_of(arguments.tolerance), unit)
                                              : counted(review.plan.tests().size(), "test"));
  if (review.parts.size() == 1) text += "There is only one part, and no part is tested against itself.\n";
  if (review.split_products > 0)
    text += fmt::format(
        "Parts of one IFC product are not tested against each other ({} of several parts): "
        "--within-products tests them too.\n",
        counted(review.split_products, "product"));
  if (arguments.volumes) text += volumes_text(review);
  text += triage_summary(review, arguments);
  const std::uint64_t failing = count_failing(review);
  text += fmt::format("{} ({}).\n",
                      failing == 0   ? "No pair fails"
                      : failing == 1 ? "1 pair fails"
                                     : grouped(failing) + " pairs fail",
                      review.plan.tests().empty() ? fmt::format("{}", fmt::join(words_of(arguments.fail_on), ", "))
                      : arguments.fail_on.fresh   ? "by the mode of each test, new"
                                                  : "by the mode of each test");
  if (const auto advice = advise_tolerance(review))
    text += fmt::format("{} of {} failing pairs are shallower than {}{}; --tolerance {} leaves {}.\n",
                        grouped(advice->shallower), grouped(failing), advice->tolerance, unit, advice->tolerance,
                        grouped(failing - advice->shallower));
  return text + fmt::format("{}; read in {}, judged in {}.\n", counted(review.assembly.triangles, "triangle"),
                            duration(review.read_seconds), duration(review.judge_seconds));
}

}  // namespace

std::string in_unit(const std::optional<double>& metres) {
  return metres ? fmt::format(" ({})", unit_name(*metres)) : "";
}

std::string counts_text(const std::array<std::uint64_t, 6>& counts, std::string_view apart) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (counts[i] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(counts[i]),
                          verdict == Verdict::apart ? apart : name(verdict));
  }
  return text;
}

std::string note_text(Note note) {
  switch (note) {
    case Note::none:
      return kNothing;
    case Note::overlap_within_tolerance:
      return "overlap within tolerance";
    case Note::gap_within_tolerance:
      return "gap within tolerance";
    case Note::undecided:
      return "undecided";
    case Note::tolerance_raised:
      return "tolerance raised";
  }
  return kNothing;
}

bool print_parts(std::span<const NamedPart> parts, const std::optional<double>& unit_in_metres, Sink& sink,
                 std::optional<std::size_t> width) {
  constexpr std::size_t kMostLines = 10, kLeastName = 12;
  const auto label = [&](const NamedPart& part) {
    const std::string text = printable(part.label);
    return width ? fit(text, std::max(*width / 3, kLeastName)) : text;
  };
  const auto is = [](const NamedPart& part, PartClass kind) {
    return part.part && part.part->facts.part_class == kind;
  };
  std::size_t incomplete = 0, others = 0;
  for (const NamedPart& part : parts)
    if (!part.incomplete.empty() && ++incomplete <= kMostLines)
      sink.write(fmt::format("{} is incomplete: {}\n", label(part), printable(part.incomplete)));
  if (incomplete > kMostLines)
    sink.write(fmt::format("({} more are incomplete; --json lists them.)\n", grouped(incomplete - kMostLines)));
  const std::string unit = unit_in_metres ? unit_name(*unit_in_metres) : "";
  for (const PartClass kind : {PartClass::surface, PartClass::cracked})
    for (const NamedPart& part : parts)
      if (is(part, kind) && ++others <= kMostLines)
        sink.write(
            kind == PartClass::surface
                ? fmt::format("{} is a surface: {}\n", label(part), facts_text(*part.part, unit))
                : fmt::format("{} is cracked: {}\n", label(part), counted(part.part->facts.open_edges, "open edge")));
  if (others > kMostLines)
    sink.write(fmt::format("({} more are no solids; --json lists them.)\n", grouped(others - kMostLines)));
  if (std::ranges::any_of(parts, [&](const NamedPart& part) { return is(part, PartClass::surface); }))
    sink.write("Surfaces have no inside: what lies wholly within one is not found.\n");
  return incomplete + others > 0;
}

void print_review(const Review& review, const ClashArguments& arguments, Sink& sink, std::optional<std::size_t> width,
                  const std::stop_token& stop) {
  print_pairs(review, arguments, sink, width, stop);
  std::vector<NamedPart> parts;
  for (std::size_t i = 0; i < review.parts.size(); ++i)
    parts.push_back({review.assembly.labels[i], review.assembly.objects[i].incomplete, &review.parts[i]});
  if (print_parts(parts, review.assembly.unit_in_metres, sink, width)) sink.write("\n");
  sink.write(summary(review, arguments));
}

}  // namespace impinge::cli
