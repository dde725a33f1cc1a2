// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/report.hpp"
#include "report/assembly.hpp"
#include "report/comparison/known_parts.hpp"
#include "report/comparison/previous.hpp"
#include "report/comparison/renamed_files.hpp"
#include "report/comparison/standing.hpp"
#include "report/identity.hpp"
#include "report/named_tests/grouping.hpp"
#include "report/named_tests/plan.hpp"
#include "report/part.hpp"

namespace impinge::report {

/// What `clash` found out.
struct Review {
  ReportOptions options;  ///< with what the configuration adds to them
  Assembly assembly;
  std::vector<Part> parts;              ///< for each object
  Clashes clashes;                      ///< its `parts` are moved to those above
  std::vector<std::string> file_names;  ///< for each file, as `names_of_files`
  FileNames known_names;                ///< what they were known by before they were renamed
  std::vector<Identity> identities;     ///< for each object
  std::vector<std::string> known_keys;  ///< for each object its key, or that of then where it was made anew
  std::vector<std::string> ids;         ///< for each pair a UUID that it keeps as long as its parts keep their names
  Plan plan;                            ///< without tests, if there is no configuration
  std::vector<Standing> standings;      ///< for each pair
  std::vector<std::string> axes;        ///< for each pair those of a grid that cross by it, "B/3"; empty for none
  std::vector<Resolved> resolved;       ///< what is gone since the previous run
  std::vector<std::pair<std::string, Decision>> decisions;  ///< all that were read, by their keys
  PartTypes types;
  std::size_t split_products = 0;     ///< IFC products of several parts, which were not tested against each other
  std::vector<std::string> warnings;  ///< sentences on the configuration and on renamed files
  double read_seconds = 0, judge_seconds = 0;
};

/// For each object the group within which nothing is tested, 0 for none: its IFC product, but with `--within-products`.
std::vector<std::uint32_t> groups_of(const Assembly& assembly, const ReportOptions& options);
/// How many groups have more than one object.
std::size_t count_shared(std::vector<std::uint32_t> groups);

/// How bad a pair is, the less the worse. What fails by its verdict comes before what touches, and that before what is
/// apart; first what no tolerance excuses, then what fails at the largest tolerance, then what is deeper, then by
/// verdict.
std::tuple<Verdict, double, double, Verdict> badness(Verdict verdict, double fails_below,
                                                     const std::optional<OverlapDepth>& depth);
/// The numbers of the pairs, worst first; of those as bad as each other the one with the largest area of contact, then
/// the nearest, then in canonical order.
std::vector<std::size_t> ranked(const std::vector<Clash>& pairs);

/// The interval that holds the greater of the two overlap depths; 0 where there is none.
Interval depth_of(const std::optional<OverlapDepth>& depth);
/// The same as one number, the interval's upper end, where it is no wider than a tenth of that; else as both ends with
/// `between` in between.
std::string depth_text(const OverlapDepth& depth, const std::function<std::string(double)>& text_of,
                       std::string_view between = "..");
/// That of all regions; 0 where none were looked for.
double area_of(const Clash& pair);

/// The storeys that the two parts are in, by their names, each once and in the order of the alphabet.
std::vector<std::string_view> storeys_of(const Review& review, const Clash& pair);
/// By which axes a pair is, and in which storeys: "B/3, Level 1 / Level 2". Empty: by no axes.
std::string axes_text(const Review& review, std::size_t pair);

/// Which of the two parts, "a", "b" or "a b", the reader knows to be incomplete, so that the verdict rests on a part of
/// their shape; empty for neither.
std::string incomplete_sides(const Review& review, const Clash& pair);

/// Whether `--fail-on` names this verdict.
bool names(const FailOn& fail_on, Verdict verdict);
/// How many of the pairs fail.
std::uint64_t count_failing(const Review& review);

/// Fills in by what the pairs and files are known; the previous run may be null.
void assign_ids(const Previous* previous, Review& review);

/// Fills in what the pairs are since the previous run, which may be null, and which fail.
void compare_with_previous(const Previous* previous, Review& review);

/// Whether a region of a pair that was there before is new.
bool has_new_region(const Standing& standing);
/// Whether the verdict comes before the earlier one: verdicts are in order, the worst first.
bool is_worse(const Clash& pair, const Standing& standing);

/// "new" or "persisting"; empty without a previous run.
std::string name(Change change);
/// The same; of a persisting pair "worse" if its verdict comes before the earlier one, and "new region" if
/// it has one.
std::string change_text(const Clash& pair, const Standing& standing);

/// The words of `--fail-on` that are set.
std::vector<std::string> words_of(const FailOn& fail_on);

}  // namespace impinge::report
