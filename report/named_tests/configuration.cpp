// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/configuration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "report/comparison/mistaken_file.hpp"
#include "report/json_file.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using Kind = JsonReader::Kind;

// A configuration is written by people; what is larger is another file.
constexpr std::uint64_t kMostBytes = 16'000'000;

/// A text that is not empty.
Word read_word(JsonReader& reader) {
  Word word;
  word.text = reader.string();
  word.place = reader.place();
  if (word.text.empty()) reader.fail("this text is empty");
  return word;
}

/// One word, or a list of at least one.
std::vector<Word> read_words(JsonReader& reader) {
  std::vector<Word> words;
  if (reader.kind() != Kind::array) {
    words.push_back(read_word(reader));
    return words;
  }
  const JsonReader::Place place = reader.place();
  reader.array([&] { words.push_back(read_word(reader)); });
  if (!reader.failed() && words.empty()) reader.fail("this list names nothing; leave the key out, or name something");
  return words;
}

Group read_group(JsonReader& reader);

std::vector<Group> read_groups(JsonReader& reader) {
  std::vector<Group> groups;
  reader.array([&] { groups.push_back(read_group(reader)); });
  return groups;
}

void read_group_object(JsonReader& reader, Group& group) {
  bool empty = true;
  reader.object([&](const std::string& key) {
    empty = false;
    if (key == "name") return group.names = read_words(reader), void();
    if (key == "path") return group.paths = read_words(reader), void();
    if (key == "product") return group.products = read_words(reader), void();
    if (key == "file") return group.files = read_words(reader), void();
    if (key == "group") return group.named = read_words(reader), void();
    if (key == "except") return group.except.push_back(read_group(reader)), void();
    reader.fail_unknown(key, known_keys().group);
  });
  if (!reader.failed() && empty) reader.fail("this group says nothing; {\"name\": \"*\"} is every part");
}

/// A pattern of names; an object of patterns; or a list of groups.
Group read_group(JsonReader& reader) {
  Group group;
  switch (reader.kind()) {
    case Kind::string:
      group.names.push_back(read_word(reader));
      group.place = group.names.back().place;
      break;
    case Kind::object:
      group.place = reader.place();
      read_group_object(reader, group);
      break;
    case Kind::array:
      group.place = reader.place();
      group.any = read_groups(reader);
      if (!reader.failed() && group.any.empty()) reader.fail("this group names nothing");
      break;
    default:
      reader.fail("a group is a pattern of names, an object such as {\"file\": \"steel.glb\"}, or a list of groups");
  }
  return group;
}

/// [group, group]
GroupPair read_pair(JsonReader& reader) {
  std::vector<Group> groups = read_groups(reader);
  if (!reader.failed() && groups.size() != 2) reader.fail("a pair is a list of two groups");
  if (reader.failed()) return {};
  return {std::move(groups[0]), std::move(groups[1])};
}

std::vector<GroupPair> read_pairs(JsonReader& reader) {
  std::vector<GroupPair> pairs;
  reader.array([&] { pairs.push_back(read_pair(reader)); });
  return pairs;
}

IgnoreRules read_ignore(JsonReader& reader) {
  IgnoreRules rules;
  reader.object([&](const std::string& key) {
    if (key == "same_file") return rules.same_file = reader.boolean(), void();
    if (key == "same_parent") return rules.same_parent = reader.boolean(), void();
    if (key == "pairs") return rules.pairs = read_pairs(reader), void();
    if (key == "within") return rules.within = read_groups(reader), void();
    reader.fail_unknown(key, known_keys().ignore);
  });
  return rules;
}

MayTouch read_may_touch(JsonReader& reader) {
  MayTouch touch;
  if (reader.kind() == Kind::boolean)
    touch.all = reader.boolean();
  else
    touch.pairs = read_pairs(reader);
  return touch;
}

Mode read_mode(JsonReader& reader) {
  const std::string word = reader.string();
  for (const Mode mode : {Mode::penetration, Mode::contact, Mode::clearance})
    if (word == name(mode)) return mode;
  reader.fail(fmt::format("a mode is penetration, contact or clearance, not '{}'", fit(printable(word), 80)));
  return Mode::penetration;
}

std::optional<double> read_tolerance(JsonReader& reader) {
  if (reader.kind() != Kind::string) return read_length(reader);
  if (reader.string() != "auto") reader.fail("a tolerance is \"auto\" or a length from 0 up");
  return std::nullopt;
}

/// Whether the key is one of those that a test and the whole configuration have in common.
bool read_term(JsonReader& reader, const std::string& key, Terms& terms) {
  if (key == "mode")
    terms.mode = read_mode(reader);
  else if (key == "tolerance")
    terms.tolerance = read_tolerance(reader);
  else if (key == "clearance")
    terms.clearance = read_length(reader, true);
  else if (key == "ignore")
    terms.ignore = read_ignore(reader);
  else if (key == "may_touch")
    terms.may_touch = read_may_touch(reader);
  else
    return false;
  return true;
}

NamedTest read_test(JsonReader& reader) {
  NamedTest test;
  test.place = reader.place_of_next();
  bool has_a = false;
  reader.object([&](const std::string& key) {
    if (key == "clearance") test.clearance_place = reader.place();
    if (key == "name") return test.name = read_word(reader), void();
    if (key == "a") return has_a = true, test.a = read_group(reader), void();
    if (key == "b") return test.b = read_group(reader), void();
    if (!read_term(reader, key, test.terms)) reader.fail_unknown(key, known_keys().test);
  });
  if (reader.failed()) return test;
  if (test.name.text.empty()) reader.fail("this test has no \"name\"");
  if (!has_a) reader.fail("this test has no group \"a\"; {\"name\": \"*\"} is every part");
  return test;
}

NamedFile read_file(JsonReader& reader) {
  NamedFile file;
  if (reader.kind() != Kind::object) {
    file.file = read_word(reader);
    return file;
  }
  reader.object([&](const std::string& key) {
    if (key == "file") return file.file = read_word(reader), void();
    if (key == "scale") return file.scale = read_length(reader, true), void();
    reader.fail_unknown(key, known_keys().file);
  });
  if (!reader.failed() && file.file.text.empty()) reader.fail("this object has no \"file\"");
  return file;
}

std::string no_configuration(std::string_view what) {
  return fmt::format(
      "this is no configuration, such as {{\"tests\": [{{\"name\": \"all\", \"a\": \"*\"}}]}} (docs/triage.md): {}",
      what);
}

void read_object(JsonReader& reader, Configuration& to) {
  bool has_tests = false;
  if (is_gltf(reader.keys()))
    return reader.fail(no_configuration("it is a glTF file; name it after the configuration, or among its \"files\""));
  reader.object([&](const std::string& key) {
    if (key == "$schema") return reader.string(), void();
    if (key == "version") return reader.fail(no_configuration("it is a report, as --json writes it"));
    if (key == "files") return reader.array([&] { to.files.push_back(read_file(reader)); });
    if (key == "groups")
      return reader.object([&](const std::string& group) { to.groups.emplace(group, read_group(reader)); });
    if (key == "tests") return has_tests = true, reader.array([&] { to.tests.push_back(read_test(reader)); });
    if (!read_term(reader, key, to.terms)) reader.fail_unknown(key, known_keys().configuration);
  });
  if (!reader.failed() && (!has_tests || to.tests.empty())) reader.fail("there are no \"tests\"");
}

}  // namespace

double read_length(JsonReader& reader, bool positive) {
  const double length = reader.number();
  if (!reader.failed() && !(positive ? length > 0 : length >= 0))
    reader.fail(positive ? "this must be above 0" : "a length is 0 or more");
  return length + 0.0;  // -0 is 0
}

std::string_view name(Mode mode) {
  switch (mode) {
    case Mode::penetration:
      return "penetration";
    case Mode::contact:
      return "contact";
    case Mode::clearance:
      return "clearance";
  }
  return "";
}

const KnownKeys& known_keys() {
  static const KnownKeys keys{
      .configuration = {"$schema", "files", "groups", "mode", "tolerance", "clearance", "ignore", "may_touch", "tests"},
      .test = {"name", "a", "b", "mode", "tolerance", "clearance", "ignore", "may_touch"},
      .group = {"name", "path", "product", "file", "group", "except"},
      .ignore = {"same_file", "same_parent", "pairs", "within"},
      .file = {"file", "scale"},
      .clash_set = {"name", "mode", "a", "b", "tolerance", "clearance", "allow_touching", "check_all", "clashes"},
      .source = {"file", "selector", "mode"}};
  return keys;
}

Result<Configuration> parse_configuration(std::string name, std::string text) {
  Configuration configuration;
  configuration.name = std::move(name);
  configuration.text = std::move(text);
  if (const std::string instead = what_it_is_instead(configuration.text); !instead.empty())
    return configuration.error_at({}, no_configuration(instead));
  JsonReader reader(configuration.text, configuration.name);
  if (reader.kind() == Kind::array)
    read_clash_sets(reader, configuration);
  else
    read_object(reader, configuration);
  if (reader.failed()) return reader.error();
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
          test.clearance_place,
          fmt::format("only mode clearance keeps a clearance, and this test has mode {}", name(mode)));
  }
  return {};
}

Result<Configuration> read_configuration(const std::string& name) {
  Result<std::string> text = read_text_file(name, kMostBytes);
  if (!text) return text.error();
  return parse_configuration(name, *std::move(text));
}

}  // namespace impinge::report
