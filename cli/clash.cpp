// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "clash_table.hpp"
#include "commands.hpp"
#include "documents.hpp"
#include "exports.hpp"
#include "progress.hpp"
#include "report/clash_json.hpp"
#include "report/decisions.hpp"
#include "report/named_tests/configuration.hpp"
#include "report/named_tests/named_files.hpp"
#include "report/page.hpp"
#include "report/review.hpp"
#include "report/text.hpp"
#include "scene_command.hpp"
#include "triage_table.hpp"

namespace impinge::cli {
namespace {

/// The command line with what its configuration adds to it.
struct ConfiguredClash {
  ClashArguments arguments;
  std::optional<Configuration> configuration;
};

Error said_twice(const Configuration& configuration, std::string_view option) {
  return {Code::bad_option, fmt::format("--{0} is given, and {1} has a \"{0}\" for all tests; leave one out", option,
                                        printable(configuration.name))};
}

/// Whether a test has the mode clearance and no clearance of its own, so that it takes the one of the command line.
bool has_use_for_clearance(const Configuration& configuration) {
  return std::any_of(configuration.tests.begin(), configuration.tests.end(), [&](const NamedTest& test) {
    return configuration.mode_of(test) == Mode::clearance && !test.terms.clearance;
  });
}

/// Reads the configuration, if there is one. Errors: those of `read_configuration` and `add_files`; `bad_option` (said
/// twice, by an option and for all tests).
Result<ConfiguredClash> configure(const ClashArguments& given) {
  ConfiguredClash configured{given, {}};
  if (!given.config) return configured;
  Result<Configuration> read = read_configuration(*given.config);
  if (!read) return read.error();
  Configuration& configuration = configured.configuration.emplace(*std::move(read));
  ClashArguments& to = configured.arguments;
  if (given.tolerance && configuration.terms.tolerance) return said_twice(configuration, "tolerance");
  if (given.clearance > 0 && configuration.terms.clearance) return said_twice(configuration, "clearance");
  if (given.tolerance) configuration.terms.tolerance = given.tolerance;
  if (given.clearance > 0) configuration.terms.clearance = given.clearance;
  if (given.clearance > 0 && !has_use_for_clearance(configuration))
    configuration.warnings.push_back(fmt::format(
        "--clearance {} changes nothing: no test in {} has the mode clearance without a \"clearance\" of its own",
        given.clearance, printable(configuration.name)));
  if (auto checked = check(configuration); !checked) return checked.error();
  if (auto added = add_files(configuration, to); !added) return added.error();
  if (to.files.empty())
    return Error{Code::bad_option,
                 fmt::format("no file to read is named, neither in {} nor after it", printable(configuration.name))};
  // The table and the JSON have distances if some test has the mode clearance.
  to.clearance = 0;
  for (const NamedTest& test : configuration.tests)
    if (configuration.mode_of(test) == Mode::clearance)
      to.clearance = std::max(to.clearance, configuration.clearance_of(test));
  return configured;
}

Result<Clashes> judge_all(const ClashArguments& arguments, const Scene& scene, const Plan& plan, ProgressLine& line,
                          const std::stop_token& stop) {
  Progress progress;
  ClashOptions options;
  options.tolerance = arguments.tolerance;
  options.clearance = arguments.clearance;
  options.depth = arguments.depth;
  options.regions = arguments.regions;
  options.threads = arguments.threads;
  if (!plan.tests().empty()) {
    options.clearance = plan.reach();
    options.terms = [&plan](std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms) {
      plan.terms(a, b, terms);
    };
  }
  options.progress = &progress;
  options.stop = stop;
  line.phase(
      fmt::format("judging {}", counted(scene.size(), "part")), [&progress] { return work_of(progress); }, "steps");
  Result<Clashes> clashes = find_clashes(scene, options);
  line.end();  // its thread reads `progress`
  if (stop.stop_requested()) return interrupted();
  return clashes;
}

/// The configuration and the earlier run, where they are given.
struct Triage {
  const Configuration* configuration = nullptr;
  const Previous* previous = nullptr;
};

Result<Review> make_review(const ClashArguments& arguments, const Triage& triage, const std::stop_token& stop) {
  ProgressLine line(STDERR_FILENO, !arguments.quiet);
  Review review;
  const auto start = Clock::now();
  Result<Assembly> assembly = read_assembly(arguments, line, stop);
  if (!assembly) return assembly.error();
  review.assembly = std::move(*assembly);
  review.read_seconds = seconds_since(start);

  const auto read = Clock::now();
  if (triage.configuration != nullptr) {
    Result<Plan> plan = Plan::make(*triage.configuration, review.assembly);
    if (!plan) return plan.error();
    review.plan = *std::move(plan);
  }
  const std::vector<std::uint32_t> groups = groups_of(review.assembly, arguments);
  review.split_products = count_shared(groups);
  const Result<Scene> scene = scene_of(review.assembly, arguments, groups);
  if (!scene) return scene.error();
  Result<Clashes> clashes = judge_all(arguments, *scene, review.plan, line, stop);
  if (!clashes) return clashes.error();
  review.clashes = std::move(*clashes);
  review.judge_seconds = seconds_since(read);

  review.parts.reserve(review.clashes.parts.size());
  for (std::size_t i = 0; i < review.clashes.parts.size(); ++i) {
    const io::Object& object = review.assembly.objects[i];
    review.parts.push_back(describe(review.clashes.parts[i], object.mesh, object.pose));
  }
  review.clashes.parts.clear();
  identify(triage.previous, review);
  review.types = types_of(review.assembly);
  take_stock(arguments, triage.previous, review);
  return review;
}

/// Says which keys of the decisions match no pair: the clash may be solved, or the key is misspelt.
void mention_unmatched(const std::vector<std::string>& keys, const std::string& file) {
  constexpr std::size_t kMostNamed = 10;
  for (std::size_t i = 0; i < std::min(keys.size(), kMostNamed); ++i)
    complain(fmt::format("{}: no pair of this run is '{}'; if that clash is solved, delete the key", file, keys[i]));
  if (keys.size() > kMostNamed)
    complain(fmt::format("{}: {} match no pair either", file, counted(keys.size() - kMostNamed, "other key")));
}

Result<void> print_on_standard_output(const Review& review, const ClashArguments& arguments,
                                      const std::stop_token& stop) {
  Sink out(STDOUT_FILENO, "standard output");
  print_review(review, arguments, out, width_of(STDOUT_FILENO), stop);
  if (stop.stop_requested()) return interrupted();
  return out.flush();
}

}  // namespace

Result<bool> clash(const ClashArguments& given, const std::stop_token& stop) {
  const Result<ConfiguredClash> configured = configure(given);
  if (!configured) return configured.error();
  const ClashArguments& arguments = configured->arguments;
  if (configured->configuration && !arguments.quiet)
    for (const std::string& warning : configured->configuration->warnings) complain(warning);
  std::vector<std::string> inputs = arguments.files;
  if (arguments.config) inputs.push_back(*arguments.config);
  if (arguments.decisions) inputs.push_back(*arguments.decisions);
  Documents documents(inputs, arguments.force);
  if (auto ordered = documents.order(kJson, arguments.json); !ordered) return ordered.error();
  if (auto ordered = documents.order(kPage, arguments.html); !ordered) return ordered.error();
  if (auto ordered = order_exports(documents, arguments); !ordered) return ordered.error();
  const Result<std::string> page = arguments.html ? read_page_template() : std::string();
  if (!page) return page.error();
  // It is read before the long work, which would be lost if the file cannot be used.
  const Result<Previous> previous =
      arguments.previous ? read_previous(*arguments.previous, arguments.max_file_bytes) : Previous();
  if (!previous) return previous.error();
  const Result<Decisions> decisions = arguments.decisions ? read_decisions(*arguments.decisions) : Decisions();
  if (!decisions) return decisions.error();
  Result<Review> review = make_review(
      arguments,
      {configured->configuration ? &*configured->configuration : nullptr, arguments.previous ? &*previous : nullptr},
      stop);
  if (!review) return review.error();
  const std::vector<std::string> unmatched = decide(*decisions, *review);
  mention_missing(review->assembly);
  if (!arguments.quiet) {
    mention_warnings(review->assembly);
    if (arguments.previous) mention_renamed(review->known_names, *arguments.previous);
    mention_unmatched(unmatched, arguments.decisions.value_or(""));
  }
  const auto write_json = [&](Sink& sink) { return write_clash_json(sink, *review, arguments, stop); };
  if (auto written = documents.write(kJson, write_json); !written) return written.error();
  const auto write_html = [&](Sink& sink) -> Result<void> {
    const Result<DrawnScene> scene = draw(review->assembly, arguments.page_triangles, stop);
    if (!scene) return scene.error();
    if (!arguments.quiet) mention_simplified(*scene);
    return write_page(sink, *page, head_of(arguments.files, arguments), *scene, write_json, stop);
  };
  if (auto written = documents.write(kPage, write_html); !written) return written.error();
  if (auto written = write_exports(documents, *review, arguments, stop); !written) return written.error();
  if (auto put = documents.put(); !put) return put.error();
  if (!arguments.quiet && !documents.on_standard_output()) {
    if (auto printed = print_on_standard_output(*review, arguments, stop); !printed) return printed.error();
  }
  return count_failing(*review) > 0;
}

}  // namespace impinge::cli
