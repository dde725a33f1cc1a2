// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The clash sets of IfcClash (IfcOpenShell, src/ifcclash): a list of {name, mode, a, b, ...}, where a and b are lists
/// of {file, selector, mode}.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "report/json_file.hpp"
#include "report/named_tests/configuration.hpp"
#include "report/schemas.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

/// Whether a selector takes everything, as an empty one does.
bool is_everything(std::string_view selector) {
  while (selector.starts_with(' ')) selector.remove_prefix(1);
  while (selector.ends_with(' ')) selector.remove_suffix(1);
  return selector.empty() || selector == "IfcElement" || selector == "IfcProduct";
}

/// The text that stands here, or an empty one in place of null or nothing.
Word read_text(const JsonNode& object, const char* key) {
  const auto node = object.find(key);
  if (!node || node->value.is_null()) return {};
  return {node->value.get<std::string>(), node->place.to_string()};
}

/// A selector that is not looked at, because there is no mode, and the name of the clash set that it is in.
struct IgnoredSelector {
  Word selector;
  std::string set;
};

/// {file, selector, mode}, of a clash set.
Group read_source(const JsonNode& node, const std::string& set, std::vector<IgnoredSelector>& ignored) {
  Group source;
  source.place = node.place.to_string();
  source.files.push_back(read_text(node, "file"));
  const Word selector = read_text(node, "selector");
  const std::string mode = read_text(node, "mode").text;
  if (is_everything(selector.text)) return source;
  if (mode.empty()) ignored.push_back({selector, set});
  if (mode == "i") source.selects.push_back(selector);
  if (mode == "e") {
    Group& except = source.except.emplace_back();
    except.selects.push_back(selector);
    except.place = selector.place;
  }
  return source;
}

Group read_sources(const JsonNode& node, const std::string& set, std::vector<IgnoredSelector>& ignored) {
  Group group;
  group.place = node.place.to_string();
  group.any = node.each([&](const JsonNode& each) { return read_source(each, set, ignored); });
  return group;
}

/// IfcClash looks at a selector only with a mode beside it, which is easily forgotten.
void warn(const std::vector<IgnoredSelector>& ignored, Configuration& to) {
  constexpr std::size_t kMost = 5;  // more of them tell nothing new
  for (std::size_t i = 0; i < std::min(ignored.size(), kMost); ++i) {
    const std::string what = fmt::format(
        "the clash set '{}' takes all of this file: as with IfcClash, the selector '{}' counts only with a \"mode\" "
        "beside it, \"i\" to take what it names, \"e\" to leave that out, or \"a\" if all is meant",
        fit(printable(ignored[i].set), 80), fit(printable(ignored[i].selector.text), 80));
    to.warnings.push_back(to.error_at(ignored[i].selector.place, what).message);
  }
  if (ignored.size() > kMost)
    to.warnings.push_back(fmt::format("{}: {} more with a selector and no \"mode\"; add a mode to each", to.name,
                                      counted(ignored.size() - kMost, "source")));
}

NamedTest read_clash_set(const JsonNode& node, std::vector<IgnoredSelector>& ignored) {
  NamedTest test;
  test.place = node.place.to_string();
  test.name = read_text(node, "name");
  test.a = read_sources(node["a"], test.name.text, ignored);
  if (const auto b = node.find("b"); b && !b->value.empty()) test.b = read_sources(*b, test.name.text, ignored);
  // Each of the lengths and flags is for one mode; the program that writes these files writes all of them.
  const std::string mode = node.value.value("mode", "intersection");
  if (mode == "clearance") {
    test.terms.mode = Mode::clearance;
    test.terms.clearance = node.value.value("clearance", 0.0);
  } else if (mode == "collision" && node.value.value("allow_touching", false)) {
    test.terms.mode = Mode::contact;
  } else {
    test.terms.mode = Mode::penetration;
  }
  if (mode == "intersection" && node.value.contains("tolerance"))
    test.terms.tolerance = std::optional<Length>(node.value["tolerance"].get<double>() + 0.0);  // -0 is 0
  return test;
}

}  // namespace

Result<void> read_clash_sets(const JsonNode& sets, Configuration& to) {
  static const json schema = json::parse(kClashSetsSchema);
  if (auto valid = check_against(schema, to.name, to.text, sets.value); !valid) return valid;
  std::vector<IgnoredSelector> ignored;
  to.tests = sets.each([&](const JsonNode& set) { return read_clash_set(set, ignored); });
  warn(ignored, to);
  return {};
}

}  // namespace impinge::report
