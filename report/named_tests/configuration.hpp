// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/report.hpp"
#include "report/named_tests/ifc_classes.hpp"
#include "report/named_tests/selector.hpp"

/// What `clash --config` is told: named tests between groups of parts (docs/triage.md, docs/clash.schema.json).
namespace impinge::report {

/// A text of the configuration. Places are JSON pointers into its file, for messages.
struct Word {
  std::string text;
  std::string place;
  std::string written{};  ///< how it stands in the file, if not as the text
  [[nodiscard]] const std::string& shown() const { return written.empty() ? text : written; }
};

/// What parts have as a property, any of the words; a name as `io::Object::properties` has it.
struct PropertyWords {
  std::string name;
  std::vector<Word> words;
};

/// A set of parts: those that agree with every list that is not empty, each by one of its words, and with one of the
/// groups of `any` if there are some; and of these, not what `except` names.
struct Group {
  std::vector<Word> names, paths, products, files;
  std::vector<Word> classes;              ///< of IFC, each with what is derived from it
  std::vector<Word> selects;              ///< selectors of IfcOpenShell
  std::vector<Word> named;                ///< groups of the configuration
  std::vector<PropertyWords> properties;  ///< which all hold
  std::vector<Group> any;
  std::vector<Group> except;
  std::string place;
};

enum class Mode : std::uint8_t {
  penetration,  ///< duplicate, inside, penetrating and crossing
  contact,      ///< and touching
  clearance,    ///< and whatever is nearer than the clearance
};

using GroupPair = std::pair<Group, Group>;

/// Pairs that are not judged.
struct IgnoreRules {
  std::optional<bool> same_file, same_parent;
  std::vector<GroupPair> pairs;
  std::vector<Group> within;  ///< no two parts of such a group
  std::vector<const DesignRule*> by_design;
};

/// Contacts by design: touching is no failure.
struct MayTouch {
  bool all = false;
  std::vector<GroupPair> pairs;
};

/// What may be said of one test, or of all.
struct Terms {
  std::optional<Mode> mode;
  std::optional<std::optional<Length>> tolerance;  ///< inside: nothing is "auto"
  std::optional<Length> clearance;
  IgnoreRules ignore;
  std::optional<MayTouch> may_touch;
};

struct NamedTest {
  std::string place;
  Word name;
  Group a;
  std::optional<Group> b;  ///< nothing: a against itself
  Terms terms;
};

struct NamedFile {
  Word file;
  std::optional<double> scale;
};

struct Configuration {
  std::string name;  ///< of its file, as it was given
  std::string text;  ///< of its file: places in it are told by line
  std::vector<NamedFile> files;
  std::map<std::string, Group> groups;
  Terms terms;
  std::vector<NamedTest> tests;
  std::vector<std::string> warnings;  ///< sentences on what was read, and is not what it looks like

  [[nodiscard]] Mode mode_of(const NamedTest& test) const {
    return test.terms.mode.value_or(terms.mode.value_or(Mode::penetration));
  }
  /// In the unit that was said; 0 unless the test's mode keeps a clearance.
  [[nodiscard]] double clearance_of(const NamedTest& test) const {
    return mode_of(test) == Mode::clearance ? test.terms.clearance.value_or(terms.clearance.value_or(0)).value : 0;
  }
  /// `bad_file`, with the line and the place.
  [[nodiscard]] Error error_at(const std::string& place, std::string_view what) const;
};

/// Reads a configuration, or the clash sets of IfcClash. Errors: `bad_file`, with the line and the place.
Result<Configuration> read_configuration(const std::string& name);
/// The same of a text.
Result<Configuration> parse_configuration(std::string name, std::string text);

/// What the form of a configuration cannot say: names stand once, and each test has the clearance that it needs and no
/// other. Errors: `bad_file`.
Result<void> check(const Configuration& configuration);

/// All groups of the configuration, those within others too.
std::vector<const Group*> groups_in(const Configuration& configuration);

/// Whether any group asks for property sets. Errors: `bad_file` (a selector that is not understood).
Result<bool> needs_property_sets(const Configuration& configuration);

struct JsonNode;
/// The clash sets of IfcClash, a list, in place of a configuration. Errors: `bad_file`.
Result<void> read_clash_sets(const JsonNode& sets, Configuration& to);

/// Which of the files a word of the configuration names: the one that stands there, from the configuration's folder;
/// or else those whose name, with or without its folders, the word is or describes as a pattern.
std::vector<std::uint32_t> files_named(const Configuration& configuration, const std::string& word,
                                       const std::vector<std::string>& files);

/// Adds to the files to read those that the configuration names and that are not among them, and finds out which files
/// the given scales are for. Errors: `bad_file` (there is no such file); `bad_option` (a scale of no file, or a
/// second).
Result<void> add_files(const Configuration& configuration, ReportOptions& options);

std::string_view name(Mode mode);

}  // namespace impinge::report
