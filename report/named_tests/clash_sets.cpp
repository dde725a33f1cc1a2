// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The clash sets of IfcClash (IfcOpenShell, src/ifcclash): a list of {name, mode, a, b, ...}, where a and b are lists
/// of {file, selector, mode}.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "report/named_tests/configuration.hpp"
#include "report/named_tests/ifc_classes.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using Kind = JsonReader::Kind;

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
Group read_selected(std::string_view word, const JsonReader::Place& place) {
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
std::vector<Group> read_selector(JsonReader& reader, Word& selector) {
  selector.text = reader.string();
  selector.place = reader.place();
  const std::string& text = selector.text;
  std::vector<Group> groups;
  std::string_view left = text;
  for (bool more = !trimmed(left).empty(); more && !reader.failed();) {
    const std::size_t comma = left.find_first_of(",+");
    std::string_view word = trimmed(left.substr(0, comma));
    more = comma != std::string_view::npos;
    if (more) left.remove_prefix(comma + 1);
    if (word.starts_with('.')) word.remove_prefix(1);  // a class, as IfcClash once wrote it
    if (word.empty() || word.find_first_of("=!<>|&@\"") != std::string_view::npos ||
        (text.find(',') != std::string::npos && !is_class(word))) {
      reader.fail(
          fmt::format("the selector '{}' is a query that impinge does not answer; it takes classes such as IfcWall, a "
                      "global id after '#', or a pattern of names",
                      fit(printable(text), 80)));
      return {};
    }
    if (is_everything(word)) return {};
    if (is_class(word) && !is_ifc_class(word)) {
      reader.fail(
          fmt::format("impinge knows no class '{}' of IFC; the nearest is '{}'. Write classes that it is above, or "
                      "in a configuration of impinge's own \"product\": \"{}_*\"",
                      fit(printable(word), 80), nearest_ifc_class(word), fit(printable(word), 80)));
      return {};
    }
    groups.push_back(read_selected(word, selector.place));
  }
  return groups;
}

/// {file, selector, mode}. A selector that is not looked at, because there is no mode, goes into `ignored`.
Group read_source(JsonReader& reader, std::vector<Word>& ignored) {
  Group source;
  Word selector;
  std::vector<Group> selected;
  std::string mode;
  source.place = reader.place_of_next();
  reader.object([&](const std::string& key) {
    if (key == "file") {
      source.files.push_back({reader.string(), {}});
      source.files.back().place = reader.place();
    } else if (key == "selector") {
      if (reader.kind() == Kind::null)
        reader.skip();
      else
        selected = read_selector(reader, selector);
    } else if (key == "mode") {
      mode = reader.kind() == Kind::null ? (reader.skip(), std::string()) : reader.string();
      if (!mode.empty() && mode != "a" && mode != "i" && mode != "e")
        reader.fail("the mode of a source is i (include), e (exclude) or a (all)");
    } else {
      reader.fail_unknown(key, known_keys().source);
    }
  });
  if (reader.failed()) return source;
  if (source.files.empty() || source.files.front().text.empty()) reader.fail("this source has no \"file\"");
  if (!selected.empty() && mode.empty()) ignored.push_back(std::move(selector));
  if (selected.empty() || (mode != "i" && mode != "e")) return source;
  if (mode == "e") {
    source.except = std::move(selected);
    return source;
  }
  for (Group& group : selected) group.files = source.files;
  source.files.clear();
  source.any = std::move(selected);
  return source;
}

std::optional<Group> read_sources(JsonReader& reader, std::vector<Word>& ignored) {
  Group group;
  if (reader.kind() == Kind::null) return reader.skip(), std::nullopt;
  group.place = reader.place_of_next();
  reader.array([&] { group.any.push_back(read_source(reader, ignored)); });
  if (group.any.empty()) return std::nullopt;
  return group;
}

/// A selector that is not looked at, and the name of the clash set that it is in.
struct IgnoredSelector {
  Word selector;
  std::string set;
};

/// IfcClash looks at a selector only with a mode beside it, which is easily forgotten.
void warn(const JsonReader& reader, const std::vector<IgnoredSelector>& ignored, std::vector<std::string>& warnings) {
  constexpr std::size_t kMost = 5;  // more of them tell nothing new
  for (std::size_t i = 0; i < std::min(ignored.size(), kMost); ++i) {
    const std::string what = fmt::format(
        "the clash set '{}' takes all of this file: as with IfcClash, the selector '{}' counts only with a \"mode\" "
        "beside it, \"i\" to take what it names, \"e\" to leave that out, or \"a\" if all is meant",
        fit(printable(ignored[i].set), 80), fit(printable(ignored[i].selector.text), 80));
    warnings.push_back(reader.error_at(ignored[i].selector.place, what).message);
  }
  if (ignored.size() > kMost)
    warnings.push_back(
        fmt::format("{} more with a selector and no \"mode\"", counted(ignored.size() - kMost, "source")));
}

NamedTest read_clash_set(JsonReader& reader, std::vector<IgnoredSelector>& to_warn_of) {
  NamedTest test;
  test.place = reader.place_of_next();
  std::string mode = "intersection";
  std::optional<Group> a;
  std::optional<double> tolerance, clearance;
  std::vector<Word> ignored;
  bool allow_touching = false;
  reader.object([&](const std::string& key) {
    if (key == "name") {
      test.name.text = reader.string();
      test.name.place = reader.place();
    } else if (key == "mode") {
      mode = reader.string();
      if (mode != "intersection" && mode != "collision" && mode != "clearance")
        reader.fail("the mode of a clash set is intersection, collision or clearance");
    } else if (key == "a") {
      a = read_sources(reader, ignored);
    } else if (key == "b") {
      test.b = read_sources(reader, ignored);
    } else if (key == "tolerance") {
      tolerance = read_length(reader);
    } else if (key == "clearance") {
      clearance = read_length(reader);
    } else if (key == "allow_touching") {
      allow_touching = reader.boolean();
    } else if (key == "check_all") {
      reader.boolean();  // whatever it says, all are found, and the worst depth of each
    } else if (key == "clashes") {
      reader.skip();  // an earlier result
    } else {
      reader.fail_unknown(key, known_keys().clash_set);
    }
  });
  if (reader.failed()) return test;
  if (test.name.text.empty()) reader.fail("this clash set has no \"name\"");
  if (!a) reader.fail("this clash set has no sources \"a\"");
  if (mode == "clearance" && clearance.value_or(0) == 0) reader.fail("mode clearance needs a \"clearance\" above 0");
  if (reader.failed()) return test;
  test.a = *std::move(a);
  for (Word& selector : ignored) to_warn_of.push_back({std::move(selector), test.name.text});
  test.terms.mode = mode == "clearance"                     ? Mode::clearance
                    : mode == "collision" && allow_touching ? Mode::contact
                                                            : Mode::penetration;
  // Each of the three lengths and flags is for one mode; the program that writes these files writes all of them.
  if (mode == "intersection" && tolerance) test.terms.tolerance = tolerance;
  if (mode == "clearance") test.terms.clearance = clearance;
  return test;
}

}  // namespace

void read_clash_sets(JsonReader& reader, Configuration& to) {
  std::vector<IgnoredSelector> ignored;
  reader.array([&] { to.tests.push_back(read_clash_set(reader, ignored)); });
  if (!reader.failed() && to.tests.empty()) reader.fail("this list has no clash sets in it");
  if (!reader.failed()) warn(reader, ignored, to.warnings);
}

}  // namespace impinge::report
