// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/make_review.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "report/place.hpp"
#include "report/scene.hpp"
#include "report/text.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

Error said_twice(const Configuration& configuration, std::string_view option) {
  return {Code::bad_option, fmt::format("--{0} is given, and {1} has a \"{0}\" for all tests; leave one out", option,
                                        printable(configuration.name))};
}

/// The clearance of the command line is for tests that keep one and do not say which.
bool has_use_for_clearance(const Configuration& configuration) {
  return std::any_of(configuration.tests.begin(), configuration.tests.end(), [&](const NamedTest& test) {
    return configuration.mode_of(test) == Mode::clearance && !test.terms.clearance;
  });
}

/// Reads the configuration that the options name, and changes them as it says.
Result<void> configure(ReviewInput& input) {
  Result<Configuration> read = read_configuration(*input.options.config);
  if (!read) return read.error();
  Configuration& configuration = input.configuration.emplace(*std::move(read));
  ReportOptions& options = input.options;
  if (options.tolerance && configuration.terms.tolerance) return said_twice(configuration, "tolerance");
  if (options.clearance.value > 0 && configuration.terms.clearance) return said_twice(configuration, "clearance");
  if (options.tolerance) configuration.terms.tolerance = options.tolerance;
  if (options.clearance.value > 0) configuration.terms.clearance = options.clearance;
  if (options.clearance.value > 0 && !has_use_for_clearance(configuration))
    configuration.warnings.push_back(fmt::format(
        "--clearance {} changes nothing: no test in {} has the mode clearance without a \"clearance\" of its own",
        text_of(options.clearance), printable(configuration.name)));
  if (auto checked = check(configuration); !checked) return checked.error();
  const Result<bool> property_sets = needs_property_sets(configuration);
  if (!property_sets.has_value()) return property_sets.error();
  options.property_sets = *property_sets;
  if (auto added = add_files(configuration, options); !added) return added.error();
  if (options.files.empty())
    return Error{Code::bad_option,
                 fmt::format("no file to read is named, neither in {} nor after it", printable(configuration.name))};
  return {};
}

Result<void> bring_to_unit(Terms& terms, const std::optional<double>& metres, const std::string& where) {
  if (terms.tolerance && *terms.tolerance)
    if (auto brought = bring_to_unit(**terms.tolerance, metres, where + "tolerance"); !brought) return brought;
  return terms.clearance ? bring_to_unit(*terms.clearance, metres, where + "clearance") : Result<void>();
}

/// Brings all lengths to the unit of the files.
Result<void> bring_to_unit(ReviewInput& input, const std::optional<double>& metres) {
  ReportOptions& options = input.options;
  if (options.tolerance)
    if (auto brought = bring_to_unit(*options.tolerance, metres, "--tolerance"); !brought) return brought;
  if (auto brought = bring_to_unit(options.clearance, metres, "--clearance"); !brought) return brought;
  if (!input.configuration) return {};
  Configuration& configuration = *input.configuration;
  const std::string where = printable(configuration.name) + ": ";
  if (auto brought = bring_to_unit(configuration.terms, metres, where); !brought) return brought;
  for (NamedTest& test : configuration.tests)
    if (auto brought = bring_to_unit(test.terms, metres, where); !brought) return brought;
  // Distances are told where some test asks for them.
  options.clearance = 0;
  for (const NamedTest& test : configuration.tests)
    options.clearance = std::max(options.clearance.value, configuration.clearance_of(test));
  return {};
}

/// Says of keys in the file of decisions that they match no pair.
void warn_of_unmatched(const std::vector<std::string>& keys, Review& review) {
  constexpr std::size_t kMostNamed = 10;
  const std::string file = review.options.decisions.value_or("");
  for (std::size_t i = 0; i < std::min(keys.size(), kMostNamed); ++i)
    review.warnings.push_back(
        fmt::format("{}: no pair of this run is '{}'; if that clash is solved, delete the key", file, keys[i]));
  if (keys.size() > kMostNamed)
    review.warnings.push_back(
        fmt::format("{}: {} match no pair either", file, counted(keys.size() - kMostNamed, "other key")));
}

/// The files that `between` names, if it does. Errors: `bad_option`, of a name that is none or several of theirs.
using FilePair = std::optional<std::pair<std::uint32_t, std::uint32_t>>;
Result<FilePair> files_between(const Review& review) {
  if (!review.options.between) return FilePair();
  const std::vector<std::string>& files = review.assembly.files;
  const auto number = [&](const std::string& file) -> Result<std::uint32_t> {
    const auto count = std::ranges::count(files, file);
    if (count == 1) return static_cast<std::uint32_t>(std::ranges::find(files, file) - files.begin());
    if (count > 1)
      return Error{Code::bad_option, fmt::format("--between {}: {} of the files to read have this name; name each once",
                                                 printable(file), count)};
    return Error{Code::bad_option, fmt::format("--between {}: it is none of the files to read; the nearest is '{}'",
                                               printable(file), printable(nearest_text(file, files)))};
  };
  const auto& [first, second] = *review.options.between;
  const Result<std::uint32_t> a = number(first), b = number(second);
  if (!a) return a.error();
  if (!b) return b.error();
  const std::vector<std::string>& skipped = review.assembly.skipped;
  for (const std::string* const file : {&first, &second})
    if (std::ranges::find(skipped, *file) != skipped.end())
      return with_skipped(
          {Code::bad_option, fmt::format("--between {}: it could not be read, so no pair of it is judged; mend it, or "
                                         "leave out --between",
                                         printable(*file))},
          review.assembly);
  return FilePair({*a, *b});
}

Result<Clashes> judge_all(const Review& review, const Scene& scene) {
  ClashOptions options;
  options.tolerance = value_of(review.options.tolerance);
  options.clearance = review.options.clearance.value;
  options.depth_precision = review.options.depth_precision;
  options.regions = review.options.regions;
  options.volumes = review.options.volumes;
  options.threads = review.options.threads;
  options.backend = review.options.backend;
  const bool has_tests = !review.plan.tests().empty();
  const Result<FilePair> between = files_between(review);
  if (!between) return between.error();
  if (has_tests) options.clearance = review.plan.largest_distance();
  if (has_tests || *between) {
    const ClashTerms same_for_all{options.tolerance, options.clearance};
    options.clearance = std::max(options.clearance, options.tolerance.value_or(0));
    options.terms = [&, same_for_all](std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms) {
      const std::vector<std::uint32_t>& file_of = review.assembly.file_of;
      if (*between && std::minmax(file_of[a], file_of[b]) != std::minmax((*between)->first, (*between)->second)) return;
      if (has_tests)
        review.plan.terms(a, b, terms);
      else
        terms.push_back(same_for_all);
    };
  }
  options.progress = review.options.progress;
  options.stop = review.options.stop;
  Result<Clashes> clashes = find_clashes(scene, options);
  if (options.stop.stop_requested()) return interrupted();
  if (!clashes) return with_label(clashes.error(), review.assembly);
  return clashes;
}

}  // namespace

Result<ReviewInput> read_input(const ReportOptions& options) {
  ReviewInput input{options, {}, {}, {}};
  if (options.config)
    if (auto configured = configure(input); !configured) return configured.error();
  if (options.previous) {
    Result<Previous> previous = read_previous(*options.previous, options.max_file_bytes);
    if (!previous) return previous.error();
    input.previous = *std::move(previous);
    // Places can be compared in one unit alone.
    if (!input.options.unit_in_metres) input.options.unit_in_metres = input.previous->unit_in_metres;
  }
  if (options.decisions) {
    Result<Decisions> decisions = read_decisions(*options.decisions);
    if (!decisions) return decisions.error();
    input.decisions = *std::move(decisions);
  }
  return input;
}

Result<Review> make_review(Assembly assembly, ReviewInput input, std::optional<Clashes> known) {
  const auto start = std::chrono::steady_clock::now();
  if (auto brought = bring_to_unit(input, assembly.unit_in_metres); !brought) return brought.error();
  Review review;
  review.options = std::move(input.options);
  review.options.files = assembly.files;
  review.assembly = std::move(assembly);
  if (input.configuration) {
    review.warnings = input.configuration->warnings;
    Result<Plan> plan = Plan::make(*input.configuration, review.assembly);
    if (!plan) return with_skipped(plan.error(), review.assembly);
    review.plan = *std::move(plan);
  }
  const std::vector<std::uint32_t> groups = groups_of(review.assembly, review.options);
  review.split_products = count_shared(groups);
  if (known) {
    review.clashes = *std::move(known);
  } else {
    const Result<Scene> scene = scene_of(review.assembly, review.options, groups);
    if (!scene) return scene.error();
    Result<Clashes> clashes = judge_all(review, *scene);
    if (!clashes) return clashes.error();
    review.clashes = std::move(*clashes);
  }
  review.judge_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  review.parts.reserve(review.clashes.parts.size());
  for (std::size_t i = 0; i < review.clashes.parts.size(); ++i) {
    const io::Object& object = review.assembly.objects[i];
    review.parts.push_back(describe(review.clashes.parts[i], object.mesh, object.pose));
  }
  review.clashes.parts.clear();
  const Previous* const previous = input.previous ? &*input.previous : nullptr;
  assign_ids(previous, review);
  review.types = types_of(review.assembly);
  review.axes = axes_of(review);
  if (review.options.stop.stop_requested()) return interrupted();
  compare_with_previous(previous, review);
  if (previous && previous->unit_in_metres && previous->unit_in_metres != review.assembly.unit_in_metres)
    review.warnings.push_back(
        fmt::format("{} is in {}, and this run in {}: regions and files that were renamed are not found again",
                    printable(*review.options.previous), unit_text(previous->unit_in_metres),
                    unit_text(review.assembly.unit_in_metres)));
  if (review.options.previous)
    for (std::string& warning : renaming_warnings(review.known_names, *review.options.previous))
      review.warnings.push_back(std::move(warning));
  warn_of_unmatched(decide(input.decisions, review), review);
  if (review.options.stop.stop_requested()) return interrupted();
  review.options.progress = nullptr;  // the caller's, which need not live as long
  return review;
}

}  // namespace impinge::report
