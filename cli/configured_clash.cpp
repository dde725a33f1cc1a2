// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "configured_clash.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/named_tests/named_files.hpp"
#include "report/text.hpp"

namespace impinge::cli {
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

}  // namespace

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
  // Distances are told where some test asks for them.
  to.clearance = 0;
  for (const NamedTest& test : configuration.tests)
    if (configuration.mode_of(test) == Mode::clearance)
      to.clearance = std::max(to.clearance, configuration.clearance_of(test));
  return configured;
}

}  // namespace impinge::cli
