// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What `impinge clash` reads beside models: configurations, clash sets of IfcClash, earlier reports, and decisions as
/// JSON and as a table.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "report/comparison/previous.hpp"
#include "report/decisions.hpp"
#include "report/named_tests/configuration.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto configuration = impinge::report::parse_configuration("fuzz.json", text);
  if (configuration) {
    const auto checked = impinge::report::check(*configuration);
    if (!checked && !checked.error().message.starts_with("fuzz.json:")) std::abort();
  } else if (!configuration.error().message.starts_with("fuzz.json:")) {
    std::abort();
  }
  const auto previous = impinge::report::parse_previous("fuzz.json", text);
  if (!previous && !previous.error().message.starts_with("fuzz.json:")) std::abort();
  const auto decisions = impinge::report::parse_decisions("fuzz.json", text);
  if (!decisions && !decisions.error().message.starts_with("fuzz.json:")) std::abort();
  const auto table = impinge::report::parse_decided_table("fuzz.csv", text);
  if (!table && !table.error().message.starts_with("fuzz.csv")) std::abort();
  return 0;
}
