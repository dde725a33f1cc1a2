// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/review.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <tuple>

#include "report/text.hpp"

namespace impinge::report {
namespace {

/// The name that tells it apart from the same two parts' pairs of other tests.
std::string test_of(const Review& review, const Clash& pair) {
  return review.plan.tests().empty() ? "" : review.plan.tests()[pair.test].name;
}

}  // namespace

std::vector<std::uint32_t> groups_of(const Assembly& assembly, const ReportOptions& options) {
  if (options.within_products) return std::vector<std::uint32_t>(assembly.objects.size());
  return products_of(assembly);
}

std::size_t count_shared(std::vector<std::uint32_t> groups) {
  std::sort(groups.begin(), groups.end());
  std::size_t count = 0;
  for (std::size_t i = 1; i < groups.size(); ++i) {
    const bool is_second = groups[i] == groups[i - 1] && (i == 1 || groups[i - 2] != groups[i]);
    count += is_second && groups[i] != 0 ? 1 : 0;
  }
  return count;
}

std::tuple<Verdict, double, double, Verdict> badness(Verdict verdict, double fails_below,
                                                     const std::optional<OverlapDepth>& depth) {
  return {std::max(verdict, Verdict::crossing), -fails_below, -depth_of(depth).hi, verdict};
}

std::vector<std::size_t> ranked(const std::vector<Clash>& pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const double distance = pairs[i].nearest ? pairs[i].nearest->distance : 0;
    return std::tuple(badness(pairs[i].verdict, pairs[i].fails_below, pairs[i].overlap_depth), -area_of(pairs[i]),
                      distance, pairs[i].objects, pairs[i].test);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

Interval depth_of(const std::optional<OverlapDepth>& depth) {
  if (!depth) return {0, 0};
  return {std::max(depth->a_in_b.lo, depth->b_in_a.lo), std::max(depth->a_in_b.hi, depth->b_in_a.hi)};
}

std::string depth_text(const OverlapDepth& depth, const std::function<std::string(double)>& text_of,
                       std::string_view between) {
  const auto [least, most] = depth_of(depth);
  constexpr double kNarrow = 0.9;
  return least < kNarrow * most ? fmt::format("{}{}{}", text_of(least), between, text_of(most)) : text_of(most);
}

double area_of(const Clash& pair) {
  double area = 0;
  for (const Region& region : pair.regions) area += region.area;
  return area;
}

std::vector<std::string_view> storeys_of(const Review& review, const Clash& pair) {
  std::vector<std::string_view> storeys;
  for (const std::uint32_t object : pair.objects)
    for (const auto& [name, value] : review.assembly.objects[object].properties)
      if (name == "storey") storeys.emplace_back(value);
  std::ranges::sort(storeys);
  storeys.erase(std::unique(storeys.begin(), storeys.end()), storeys.end());
  return storeys;
}

std::string axes_text(const Review& review, std::size_t pair) {
  const std::string& axes = review.axes[pair];
  const auto storeys = storeys_of(review, review.clashes.pairs[pair]);
  if (axes.empty() || storeys.empty()) return axes;
  return fmt::format("{}, {}", axes, fmt::join(storeys, " / "));
}

std::string incomplete_sides(const Review& review, const Clash& pair) {
  const auto is_incomplete = [&](std::size_t side) {
    return !review.assembly.objects[pair.objects[side]].incomplete.empty();
  };
  if (!is_incomplete(0)) return is_incomplete(1) ? "b" : "";
  return is_incomplete(1) ? "a b" : "a";
}

bool names(const FailOn& fail_on, Verdict verdict) {
  if (verdict == Verdict::apart) return fail_on.clearance;
  if (verdict == Verdict::inside) return fail_on.contact || fail_on.inside;
  return fail_on.contact || (fail_on.penetration && verdict != Verdict::touching);
}

std::uint64_t count_failing(const Review& review) {
  return static_cast<std::uint64_t>(std::ranges::count(review.standings, true, &Standing::fails));
}

void assign_ids(const Previous* previous, Review& review) {
  review.file_names = names_of_files(review.assembly.files);
  review.known_names = known_names(review.assembly, review.file_names, previous);
  review.identities = identities_of(review.assembly, review.known_names.known_as);
  std::size_t made_anew = 0;
  review.known_keys = known_keys(review.assembly, review.known_names.known_as, review.identities, previous, made_anew);
  if (made_anew > 0)
    review.warnings.push_back(
        fmt::format("{} by shape and place alone: GlobalId or name is another than in {}",
                    counted(made_anew, "part") + (made_anew == 1 ? " is known again" : " are known again"),
                    printable(review.options.previous.value_or("the earlier run"))));
  for (const Clash& pair : review.clashes.pairs)
    review.ids.push_back(
        guid_of_pair(review.known_keys[pair.objects[0]], review.known_keys[pair.objects[1]], test_of(review, pair)));
}

void compare_with_previous(const Previous* previous, Review& review) {
  const auto is_named = [&](const Clash& pair, Verdict verdict) {
    return review.plan.tests().empty() ? names(review.options.fail_on, verdict)
                                       : review.plan.names(pair.objects[0], pair.objects[1], pair.test, verdict);
  };
  // A part that was moved by a twentieth of its size is still where it was, for a reviewer.
  const auto slack = [&](const Clash& pair) {
    return 0.1 * std::min(review.parts[pair.objects[0]].size, review.parts[pair.objects[1]].size);
  };
  review.standings = compare({review.clashes.pairs, review.ids, slack, is_named}, previous, review.resolved);
  const auto is_skipped = [&](const OldPart& part) {
    const auto& skipped = review.assembly.skipped;
    return std::any_of(skipped.begin(), skipped.end(), [&](const std::string& file) {
      return std::filesystem::path(file).filename() == std::filesystem::path(part.file).filename();
    });
  };
  std::erase_if(review.resolved, [&](const Resolved& gone) { return is_skipped(gone.a) || is_skipped(gone.b); });
  const auto is_new = [](const Standing& standing) {
    return standing.change == Change::fresh || has_new_region(standing);
  };
  for (std::size_t i = 0; i < review.standings.size(); ++i) {
    Standing& standing = review.standings[i];
    const Clash& pair = review.clashes.pairs[i];
    standing.fails = is_named(pair, pair.verdict) && (!review.options.fail_on.fresh || is_new(standing));
  }
}

bool has_new_region(const Standing& standing) {
  return std::any_of(standing.regions.begin(), standing.regions.end(),
                     [](const RegionStanding& region) { return region.change == Change::fresh; });
}

bool is_worse(const Clash& pair, const Standing& standing) { return standing.was && pair.verdict < *standing.was; }

std::string name(Change change) {
  return change == Change::unknown ? "" : change == Change::fresh ? "new" : "persisting";
}

std::string change_text(const Clash& pair, const Standing& standing) {
  if (standing.change == Change::fresh) return "new";
  const bool worse = is_worse(pair, standing);
  if (has_new_region(standing)) return worse ? "worse, new region" : "new region";
  return worse ? "worse" : "persisting";
}

std::vector<std::string> words_of(const FailOn& fail_on) {
  std::vector<std::string> words;
  if (fail_on.contact) words.emplace_back("contact");
  if (fail_on.penetration) words.emplace_back("penetration");
  if (fail_on.inside) words.emplace_back("inside");
  if (fail_on.clearance) words.emplace_back("clearance");
  if (fail_on.fresh) words.emplace_back("new");
  return words;
}

}  // namespace impinge::report
