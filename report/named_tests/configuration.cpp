// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/configuration.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "report/json_file.hpp"
#include "report/schemas.hpp"
#include "report/text.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

// A configuration is written by people; what is larger is another file.
constexpr std::uint64_t kMostBytes = 16'000'000;
/// The validator keeps some 450 bytes for each value that breaks a rule.
constexpr std::size_t kMostValues = 1'000'000;

Word read_word(const JsonNode& node) { return {node.value.get<std::string>(), node.place.to_string()}; }

/// One word, or a list of them.
std::vector<Word> read_words(const JsonNode& node) {
  return node.value.is_array() ? node.each(read_word) : std::vector{read_word(node)};
}

/// A pattern of names; an object of patterns; or a list of groups.
Group read_group(const JsonNode& node) {
  Group group;
  group.place = node.place.to_string();
  if (node.value.is_string()) group.names.push_back(read_word(node));
  if (node.value.is_array()) group.any = node.each(read_group);
  if (!node.value.is_object()) return group;
  if (const auto names = node.find("name")) group.names = read_words(*names);
  if (const auto paths = node.find("path")) group.paths = read_words(*paths);
  if (const auto products = node.find("product")) group.products = read_words(*products);
  if (const auto classes = node.find("class")) group.classes = read_words(*classes);
  if (const auto selects = node.find("select")) group.selects = read_words(*selects);
  if (const auto properties = node.find("property"))
    for (const auto& [name, words] : properties->value.items())
      group.properties.push_back({name, read_words({words, properties->place / name})});
  if (const auto files = node.find("file")) group.files = read_words(*files);
  if (const auto named = node.find("group")) group.named = read_words(*named);
  if (const auto except = node.find("except")) group.except.push_back(read_group(*except));
  return group;
}

std::vector<GroupPair> read_pairs(const JsonNode& node) {
  return node.each([](const JsonNode& pair) {
    std::vector<Group> groups = pair.each(read_group);
    return GroupPair(std::move(groups[0]), std::move(groups[1]));
  });
}

IgnoreRules read_ignore(const JsonNode& node) {
  IgnoreRules rules;
  if (const auto same_file = node.find("same_file")) rules.same_file = same_file->value.get<bool>();
  if (const auto same_parent = node.find("same_parent")) rules.same_parent = same_parent->value.get<bool>();
  if (const auto pairs = node.find("pairs")) rules.pairs = read_pairs(*pairs);
  if (const auto names = node.find("by_design"))
    for (const Word& word : names->each(read_word)) rules.by_design.push_back(find_design_rule(word.text));
  if (const auto within = node.find("within")) rules.within = within->each(read_group);
  return rules;
}

MayTouch read_may_touch(const JsonNode& node) {
  if (node.value.is_boolean()) return {.all = node.value.get<bool>(), .pairs = {}};
  return {.all = false, .pairs = read_pairs(node)};
}

Mode read_mode(const JsonNode& node) {
  const auto word = node.value.get<std::string>();
  return word == name(Mode::contact)     ? Mode::contact
         : word == name(Mode::clearance) ? Mode::clearance
                                         : Mode::penetration;
}

/// A number, or a text with a unit; nothing of other texts.
std::optional<Length> read_length(const json& value) {
  if (!value.is_string()) return value.get<double>() + 0.0;
  const std::optional<Length> length = parse_length(value.get<std::string>());
  return length && length->unit_in_metres ? length : std::nullopt;
}

/// Whether the texts that stand for lengths are some, which their schema leaves open. Errors: `bad_file`.
Result<void> check_lengths(const JsonNode& node, const json& schema, const Configuration& configuration) {
  for (const char* const key : {"tolerance", "clearance"}) {
    const auto length = node.find(key);
    if (!length || !length->value.is_string() || (key == std::string_view("tolerance") && length->value == "auto"))
      continue;
    if (const auto read = read_length(length->value); read && (read->value > 0 || key == std::string_view("tolerance")))
      continue;
    return configuration.error_at(length->place.to_string(),
                                  fmt::format("{}, not {}", schema["$defs"][key]["errorMessage"].get<std::string>(),
                                              fit(printable(length->value.dump().substr(0, 320)), 80)));
  }
  return {};
}

/// What a test and the whole configuration have in common.
Terms read_terms(const JsonNode& node) {
  Terms terms;
  if (const auto mode = node.find("mode")) terms.mode = read_mode(*mode);
  if (const auto tolerance = node.find("tolerance"))
    terms.tolerance = tolerance->value == "auto" ? std::nullopt : read_length(tolerance->value);
  if (const auto clearance = node.find("clearance")) terms.clearance = read_length(clearance->value);
  if (const auto ignore = node.find("ignore")) terms.ignore = read_ignore(*ignore);
  if (const auto may_touch = node.find("may_touch")) terms.may_touch = read_may_touch(*may_touch);
  return terms;
}

NamedTest read_test(const JsonNode& node) {
  NamedTest test{node.place.to_string(), read_word(node["name"]), read_group(node["a"]), {}, read_terms(node)};
  if (const auto b = node.find("b")) test.b = read_group(*b);
  return test;
}

NamedFile read_file(const JsonNode& node) {
  if (node.value.is_string()) return {read_word(node), {}};
  NamedFile file{read_word(node["file"]), {}};
  if (const auto scale = node.find("scale")) file.scale = scale->value.get<double>();
  return file;
}

void add_with_inner(const Group& group, std::vector<const Group*>& to) {
  to.push_back(&group);
  for (const std::vector<Group>* const inner : {&group.any, &group.except})
    for (const Group& each : *inner) add_with_inner(each, to);
}

std::string no_configuration(std::string_view what) {
  return fmt::format(
      "this is no configuration, such as {{\"tests\": [{{\"name\": \"all\", \"a\": \"*\"}}]}} (docs/triage.md): {}",
      what);
}

Result<void> read_object(const JsonNode& node, Configuration& to) {
  static const json schema = json::parse(kConfigurationSchema);
  if (node.value.contains("version"))
    return to.error_at("/version", no_configuration("it is a report, as --json writes it"));
  if (auto valid = check_against(schema, to.name, to.text, node.value); !valid) return valid;
  if (const auto files = node.find("files")) to.files = files->each(read_file);
  if (const auto groups = node.find("groups"))
    for (const auto& [name, group] : groups->value.items())
      to.groups.emplace(name, read_group({group, groups->place / name}));
  if (auto checked = check_lengths(node, schema, to); !checked) return checked;
  for (const JsonNode& test : node["tests"].each([](const JsonNode& each) { return each; }))
    if (auto checked = check_lengths(test, schema, to); !checked) return checked;
  to.terms = read_terms(node);
  to.tests = node["tests"].each(read_test);
  return {};
}

}  // namespace

std::string_view name(Mode mode) {
  constexpr std::array<std::string_view, 3> kNames{"penetration", "contact", "clearance"};
  return kNames[static_cast<std::size_t>(mode)];
}

Error Configuration::error_at(const std::string& place, std::string_view what) const {
  return json_error(name, text, place, what);
}

Result<Configuration> parse_configuration(std::string name, std::string text) {
  Configuration configuration;
  configuration.name = std::move(name);
  configuration.text = std::move(text);
  const Result<json> value = parse_json(configuration.name, configuration.text, {}, kMostValues);
  if (!value) return value.error();
  const auto read = value->is_array() ? read_clash_sets : read_object;
  if (auto done = read({*value}, configuration); !done) return done.error();
  return configuration;
}

Result<void> check(const Configuration& configuration) {
  std::set<std::string_view> names;
  for (const NamedTest& test : configuration.tests) {
    if (!names.insert(test.name.text).second)
      return configuration.error_at(test.name.place,
                                    fmt::format("two tests are named '{}'", printable(test.name.text)));
    const Mode mode = configuration.mode_of(test);
    if (mode == Mode::clearance && configuration.clearance_of(test) == 0)
      return configuration.error_at(test.place, "mode clearance needs a \"clearance\", the distance to keep");
    if (mode != Mode::clearance && test.terms.clearance)
      return configuration.error_at(
          test.place + "/clearance",
          fmt::format("only mode clearance keeps a clearance, and this test has mode {}", name(mode)));
  }
  return {};
}

std::vector<const Group*> groups_in(const Configuration& configuration) {
  std::vector<const Group*> all;
  const auto add = [&](const Group& group) { add_with_inner(group, all); };
  const auto add_pairs = [&](const std::vector<GroupPair>& pairs) {
    for (const auto& [a, b] : pairs) add(a), add(b);
  };
  const auto add_terms = [&](const Terms& terms) {
    for (const Group& group : terms.ignore.within) add(group);
    add_pairs(terms.ignore.pairs);
    if (terms.may_touch) add_pairs(terms.may_touch->pairs);
  };
  for (const auto& [_, group] : configuration.groups) add(group);
  add_terms(configuration.terms);
  for (const NamedTest& test : configuration.tests) {
    add(test.a);
    if (test.b) add(*test.b);
    add_terms(test.terms);
  }
  return all;
}

Result<bool> needs_property_sets(const Configuration& configuration) {
  bool needs = false;
  for (const Group* const group : groups_in(configuration)) {
    for (const Word& word : group->selects) {
      const Result<Selector> selector = parse_selector(word.text);
      if (!selector) return configuration.error_at(word.place, "the selector: " + selector.error().message);
      needs = needs || selector->needs_property_sets();
    }
    for (const PropertyWords& property : group->properties)
      needs = needs || property.name.find('.') != std::string::npos;
  }
  return needs;
}

Result<Configuration> read_configuration(const std::string& name) {
  Result<std::string> text = read_text_file(name, kMostBytes);
  if (!text) return text.error();
  return parse_configuration(name, *std::move(text));
}

}  // namespace impinge::report
