// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The classes of IFC's products, which are derived from which, and which overlap by design.
namespace impinge::report {

[[nodiscard]] bool is_ifc_class(std::string_view name);

/// Whether objects of the class `name` are of the class `wanted`: it is that, or derived from it.
[[nodiscard]] bool is_of_ifc_class(std::string_view name, std::string_view wanted);

/// The known class that is spelled most like the word.
[[nodiscard]] std::string nearest_ifc_class(std::string_view word);

/// A ready rule for products that overlap by design (docs/triage.md), which a configuration asks for by its name: all
/// pairs of one of the classes `a` and one of the classes `b`, each with what is derived from it.
struct DesignRule {
  std::string_view name;
  std::vector<std::string_view> a, b;
};

/// Null for a name that is none. docs/clash.schema.json has the names.
[[nodiscard]] const DesignRule* find_design_rule(std::string_view name);

}  // namespace impinge::report
