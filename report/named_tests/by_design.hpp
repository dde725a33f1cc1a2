// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

/// Ready rules for pairs of IFC products that overlap by design (docs/triage.md); a configuration names those that it
/// wants.
namespace impinge::report {

/// All pairs of a product of one of the classes `a` and one of the classes `b`, each with what is derived from it.
struct DesignRule {
  std::string_view name;
  std::vector<std::string_view> a, b;
};

/// Null for a name that is none. docs/clash.schema.json has the names.
const DesignRule* find_design_rule(std::string_view name);

}  // namespace impinge::report
