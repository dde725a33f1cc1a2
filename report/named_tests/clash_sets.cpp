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
#include "report/named_tests/ifc_classes.hpp"
#include "report/schemas.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool is_class(std::string_view word) {
  return word.starts_with("Ifc") && std::all_of(word.begin(), word.end(), is_letter_or_digit);
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// One word of a selector. Of the query language these are understood: a class, a global id, and what is a pattern of
/// names.
Group read_selected(std::string_view word, const std::string& place) {
  const auto by = [&](std::vector<Word> Group::*list, std::string text) {
    Group group;
    group.place = place;
    (group.*list).push_back({std::move(text), place, std::string(word)});
    return group;
  };
  if (is_class(word)) return by(&Group::classes, std::string(word));
  if (word.starts_with('#')) return by(&Group::products, "*" + std::string(word.substr(1)) + "*");
  return by(&Group::names, std::string(word));
}

bool is_everything(std::string_view word) { return word == "IfcElement" || word == "IfcProduct"; }

/// Empty: everything.
Result<std::vector<Group>> read_selector(const Word& selector, const Configuration& configuration) {
  const std::string& text = selector.text;
  std::vector<Group> groups;
  std::string_view left = text;
  for (bool more = !trimmed(left).empty(); more;) {
    const std::size_t comma = left.find_first_of(",+");
    std::string_view word = trimmed(left.substr(0, comma));
    more = comma != std::string_view::npos;
    if (more) left.remove_prefix(comma + 1);
    if (word.starts_with('.')) word.remove_prefix(1);  // a class, as IfcClash once wrote it
    if (word.empty() || word.find_first_of("=!<>|&@\"") != std::string_view::npos ||
        (text.find(',') != std::string::npos && !is_class(word)))
      return configuration.error_at(
          selector.place,
          fmt::format("the selector '{}' is a query that impinge does not answer; it takes classes such as IfcWall, a "
                      "global id after '#', or a pattern of names",
                      fit(printable(text), 80)));
    if (is_everything(word)) return std::vector<Group>();
    if (is_class(word) && !is_ifc_class(word))
      return configuration.error_at(
          selector.place,
          fmt::format("impinge knows no class '{}' of IFC; the nearest is '{}'. Write classes that it is above, or "
                      "in a configuration of impinge's own \"product\": \"{}_*\"",
                      fit(printable(word), 80), nearest_ifc_class(word), fit(printable(word), 80)));
    groups.push_back(read_selected(word, selector.place));
  }
  return groups;
}

/// The text that stands here, or an empty one in place of null or nothing.
Word read_text(const JsonNode& object, const char* key) {
  const auto node = object.find(key);
  if (!node || node->value.is_null()) return {};
  return {node->value.get<std::string>(), node->place.to_string()};
}

/// {file, selector, mode}. A selector that is not looked at, because there is no mode, goes into `ignored`.
Result<Group> read_source(const JsonNode& node, const Configuration& configuration, std::vector<Word>& ignored) {
  Group source;
  source.place = node.place.to_string();
  source.files.push_back(read_text(node, "file"));
  const Word selector = read_text(node, "selector");
  const std::string mode = read_text(node, "mode").text;
  Result<std::vector<Group>> selected = read_selector(selector, configuration);
  if (!selected) return selected.error();
  if (!selected->empty() && mode.empty()) ignored.push_back(selector);
  if (selected->empty() || (mode != "i" && mode != "e")) return source;
  if (mode == "e") {
    source.except = *std::move(selected);
    return source;
  }
  for (Group& group : *selected) group.files = source.files;
  source.files.clear();
  source.any = *std::move(selected);
  return source;
}

Result<Group> read_sources(const JsonNode& node, const Configuration& configuration, std::vector<Word>& ignored) {
  Group group;
  group.place = node.place.to_string();
  for (Result<Group>& source :
       node.each([&](const JsonNode& each) { return read_source(each, configuration, ignored); })) {
    if (!source) return source.error();
    group.any.push_back(*std::move(source));
  }
  return group;
}

/// A selector that is not looked at, and the name of the clash set that it is in.
struct IgnoredSelector {
  Word selector;
  std::string set;
};

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
    to.warnings.push_back(
        fmt::format("{} more with a selector and no \"mode\"", counted(ignored.size() - kMost, "source")));
}

Result<NamedTest> read_clash_set(const JsonNode& node, const Configuration& configuration,
                                 std::vector<IgnoredSelector>& to_warn_of) {
  NamedTest test;
  test.place = node.place.to_string();
  test.name = read_text(node, "name");
  std::vector<Word> ignored;
  Result<Group> a = read_sources(node["a"], configuration, ignored);
  if (!a) return a.error();
  test.a = *std::move(a);
  if (const auto b = node.find("b"); b && !b->value.empty()) {
    Result<Group> group = read_sources(*b, configuration, ignored);
    if (!group) return group.error();
    test.b = *std::move(group);
  }
  for (Word& selector : ignored) to_warn_of.push_back({std::move(selector), test.name.text});
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
  for (Result<NamedTest>& test : sets.each([&](const JsonNode& set) { return read_clash_set(set, to, ignored); })) {
    if (!test) return test.error();
    to.tests.push_back(*std::move(test));
  }
  warn(ignored, to);
  return {};
}

}  // namespace impinge::report
