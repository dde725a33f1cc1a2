// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/assembly.hpp"

/// Selectors of IfcOpenShell (docs.ifcopenshell.org, "Selector syntax"), the part of them that docs/triage.md lists.
namespace impinge::report {

/// For each object whether it is in a set.
using PartSet = std::vector<bool>;

/// A text, or a regular expression that texts begin with.
struct TextMatch {
  std::string text;
  bool is_regex = false;
};

/// One word of a selector, applied to the objects that those before it selected: a name, class or GlobalId adds objects
/// or takes them away, a value keeps the objects that have it.
struct Facet {
  enum class Kind : std::uint8_t { name, ifc_class, global_id, value };
  enum class Comparison : std::uint8_t { equal, contains, more, less, at_least, at_most };
  Kind kind = Kind::value;
  bool is_not = false;  ///< takes away; or the comparison is turned round
  std::string word;     ///< the name, class or global id
  /// Properties of an object (`io::Object::properties`, and Name), any of them; or one of a property set.
  std::vector<std::string> properties;
  TextMatch property_set, property;
  Comparison comparison = Comparison::equal;
  bool is_null = false;  ///< compared with NULL, which is said where there is no value
  TextMatch value;
  std::string written;  ///< as it stands in the selector
};

/// The union of its lists.
struct Selector {
  std::vector<std::vector<Facet>> lists;
  /// Whether it asks for property sets, which readers of files read only then.
  [[nodiscard]] bool needs_property_sets() const;
};

/// Errors: `bad_file`, a sentence that names what is not understood, or not supported.
Result<Selector> parse_selector(std::string_view text);

/// Errors: `bad_file`, a sentence that names what adds nothing, or leaves nothing.
Result<PartSet> select(const Selector& selector, const Assembly& assembly);

/// The IFC class of an object, "" for none.
std::string_view class_of(const io::Object& object);

/// The objects of this class or of one derived from it. Errors: `bad_file`, where there are none.
Result<PartSet> of_class(const Assembly& assembly, std::string_view ifc_class);

}  // namespace impinge::report
