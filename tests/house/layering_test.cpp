// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path kSource = IMPINGE_SOURCE_DIR;

/// A stage includes its own folder, core/, public headers, and these value types that it is handed.
const std::map<std::string, std::vector<std::string>> kHandedTo{
    {"core", {}},
    {"scene", {}},
    {"broad", {"scene/scene_view.hpp"}},
    // The stages from broad to exact as the paper has them, and its streams in image space.
    {"paper",
     {"scene/scene_view.hpp", "broad/may_touch.hpp", "broad/object_pairs.hpp", "hierarchy/", "partition/grid.hpp",
      "exact/", "gpu/", "shaders/"}},
    {"hierarchy", {}},
    {"partition",
     {"hierarchy/wide_leaf.hpp", "hierarchy/frame.hpp", "hierarchy/tree_relation.hpp",
      "hierarchy/frame_relation-inl.hpp"}},
    {"narrow", {"partition/pair_stream.hpp"}},
    {"exact", {}},
    {"measure",
     {"hierarchy/wide_tree.hpp", "hierarchy/wide_leaf.hpp", "hierarchy/tree_relation.hpp",
      "hierarchy/wide_boxes-inl.hpp", "hierarchy/large_leaf-inl.hpp", "hierarchy/placed_tree.hpp",
      "hierarchy/round_up.hpp", "exact/triangle_pair.hpp"}},
    {"clash",
     {"exact/contact.hpp", "exact/orientation.hpp", "exact/segment.hpp", "exact/triangle_pair.hpp", "solid/body.hpp",
      "solid/cells.hpp", "solid/classed_piece.hpp", "solid/locate.hpp", "solid/part.hpp", "solid/topology.hpp",
      "measure/nearest.hpp", "measure/triangle_distance.hpp"}},
    {"motion", {"exact/expansion.hpp", "exact/integers.hpp"}},
    {"results", {"broad/object_pairs.hpp"}},
    {"schedule", {}},
    {"solid",
     {"hierarchy/placed_tree.hpp", "exact/contact.hpp", "exact/filter.hpp", "exact/orientation.hpp",
      "exact/rational.hpp", "exact/segment.hpp", "exact/triangle_pair.hpp"}},
    // What a device does of the stages from hierarchy to narrow; and what its build makes (cmake/vulkan.cmake).
    {"gpu",
     {"hierarchy/wide_tree.hpp", "hierarchy/wide_leaf.hpp", "hierarchy/tree_relation.hpp", "hierarchy/round_up.hpp",
      "shaders/", "volk_names.h"}},
};
/// What puts the stages together: the pipelines, and the public classes and calls.
const std::vector<std::string> kAbove{"pipeline", "api"};
/// What no stage may know of: files, and (schedule apart) threads.
const std::vector<std::string> kFiles{"filesystem", "fstream", "iostream"};
const std::vector<std::string> kThreads{"tbb/", "oneapi/", "thread", "future"};
/// A container, not a thread: a tree grows in it while others read.
const std::string kGrowsWhileRead = "tbb/concurrent_vector.h";

/// What is built on the library uses public headers, its own, and these, which an answer's first numbers depend on:
/// files are read in the library's rounding mode, and a node's transform is baked where the library refuses it as a
/// pose.
const std::map<std::string, std::vector<std::string>> kBuiltOnTop{
    {"io", {"io/", "impinge/", "core/guarded.hpp", "scene/validate_pose.hpp"}},
    {"report", {"report/", "impinge/"}},
    {"cli", {"cli/", "report/", "impinge/"}},
    {"python", {"python/", "impinge/"}},
};

struct Include {
  fs::path file;  // relative to the source directory
  int line;
  bool quoted;
  std::string target;
};

std::optional<Include> parse_include(const std::string& text) {
  const auto skip = [&](std::size_t at) { return std::min(text.find_first_not_of(" \t", at), text.size()); };
  std::size_t at = skip(0);
  if (at >= text.size() || text[at] != '#') return std::nullopt;
  at = skip(at + 1);
  if (text.compare(at, 7, "include") != 0) return std::nullopt;
  at = skip(at + 7);
  if (at >= text.size() || (text[at] != '"' && text[at] != '<')) return std::nullopt;
  const bool quoted = text[at] == '"';
  const std::size_t end = text.find(quoted ? '"' : '>', at + 1);
  if (end == std::string::npos) return std::nullopt;
  return Include{{}, 0, quoted, text.substr(at + 1, end - at - 1)};
}

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> found;
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    if (auto include = parse_include(text)) {
      include->file = fs::relative(file, kSource);
      include->line = line;
      found.push_back(*include);
    }
  }
  return found;
}

bool is_source(const fs::path& file) { return file.extension() == ".hpp" || file.extension() == ".cpp"; }

std::vector<Include> includes_under(const fs::path& folder) {
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    const auto more = includes_of(entry.path());
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const auto& prefix) { return text.starts_with(prefix); });
}

bool is_any(const std::string& text, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const auto& name) { return name.ends_with('/') ? text.starts_with(name) : text == name; });
}

void complain(const Include& include, const std::string& why) {
  ADD_FAILURE() << include.file.string() << ':' << include.line << ": includes " << include.target << ", " << why;
}

/// The project's own headers are included by their path from src/ or include/, whether the name stands in quotes or
/// not.
bool is_of_project(const Include& include) {
  return include.quoted || fs::exists(kSource / "src" / include.target) || fs::exists(kSource / include.target);
}

TEST(Layering, EveryFolderOfTheSourceIsAStageOfTheTable) {
  for (const auto& entry : fs::directory_iterator(kSource / "src")) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename();
    EXPECT_TRUE(kHandedTo.contains(name) || is_any(name, kAbove)) << name << " is in no table of layering_test.cpp";
  }
}

TEST(Layering, AStageKnowsOnlyCoreAndWhatItIsHanded) {
  std::size_t seen = 0;
  for (const auto& [stage, handed] : kHandedTo) {
    if (!fs::exists(kSource / "src" / stage)) continue;
    std::vector<std::string> allowed{stage + "/", "core/", "impinge/"};
    allowed.insert(allowed.end(), handed.begin(), handed.end());
    for (const Include& include : includes_under(fs::path("src") / stage)) {
      ++seen;
      if (is_of_project(include) && !starts_with_any(include.target, allowed))
        complain(include, "which the stage " + stage + " is not handed");
    }
  }
  EXPECT_GT(seen, 100u);  // the reader of includes works
}

TEST(Layering, TheLibraryKnowsNothingOfFilesAndStagesNothingOfThreads) {
  for (const Include& include : includes_under("src")) {
    if (is_any(include.target, kFiles)) complain(include, "and the library knows nothing of files");
    const std::string folder = include.file.parent_path().filename();
    const bool may_thread = folder == "schedule" || is_any(folder, kAbove);
    if (!may_thread && include.target != kGrowsWhileRead && is_any(include.target, kThreads))
      complain(include, "which is for src/schedule");
    if (starts_with_any(include.target, {"io/", "report/", "cli/", "impinge/io.hpp", "impinge/report.hpp"}))
      complain(include, "which is built on top");
  }
}

TEST(Layering, ReadersReportsAndCommandLineUseThePublicApi) {
  for (const auto& [folder, prefixes] : kBuiltOnTop)
    for (const Include& include : includes_under(folder)) {
      if (folder == "io" && include.target == "impinge/report.hpp") complain(include, "which is built on top");
      const bool beside = include.quoted && include.target.find("..") == std::string::npos &&
                          (fs::exists(kSource / folder / include.target) ||
                           fs::exists(kSource / include.file.parent_path() / include.target));
      if (is_of_project(include) && !beside && !starts_with_any(include.target, prefixes))
        complain(include, "which is neither public nor of " + folder);
    }
}

TEST(Layering, PublicHeadersNeedTheStandardLibraryAlone) {
  for (const Include& include : includes_under("include")) {
    const bool standard = !include.quoted && include.target.find_first_of("/.") == std::string::npos;
    const bool ours = include.quoted && include.target.starts_with("impinge/");
    if (!standard && !ours) complain(include, "which is neither standard nor public");
  }
}

// One class, one name: of two that have the same name in one namespace the linker keeps one set of members for both.

/// The classes that a source defines, with their namespaces. Those without a linkage of their own are left out, and so
/// are members. It reads the project's own layout: what is in a namespace is not indented, and its end says what it is.
std::vector<std::string> classes_of(const std::string& text) {
  static const std::regex line(
      R"(^(?:namespace ([\w:]*) ?\{$|(\}  // namespace)|(?:template <.*> )?(?:class|struct|union|enum class) (?:\w+\([^)]*\) )?([\w:]+)(?: final)?(\s*[^;{(]*\{)?))",
      std::regex::multiline);
  std::vector<std::string> namespaces, found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), line); at != std::sregex_iterator(); ++at) {
    const std::smatch& match = *at;
    const auto has = [&](std::size_t group) { return match[group].matched; };
    if (has(2)) {
      EXPECT_FALSE(namespaces.empty()) << match.str();
      if (!namespaces.empty()) namespaces.pop_back();
    } else if (has(1)) {
      namespaces.push_back(match[1]);
    } else if (has(4)) {
      std::string name;
      bool is_named = true;
      for (const std::string& part : namespaces) is_named &= !part.empty(), name += part + "::";
      if (is_named) found.push_back(name + match[3].str());
    }
  }
  EXPECT_TRUE(namespaces.empty()) << "a namespace without its end";
  return found;
}

TEST(Names, AreReadFromASource) {
  const std::string text =
      "namespace impinge::cli {\n"
      "class Forward;\n"
      "struct Plain {\n  struct Member {\n  };\n};\n"
      "namespace {\nclass Local {\n};\n}  // namespace\n"
      "class Derived final : public Plain,\n                      private Other {\n};\n"
      "template <class T> struct Generic {\n};\n"
      "enum class Kind : int { one };\n"
      "struct Plain f(int x) {\n}\n"
      "}  // namespace impinge::cli\n"
      "struct Outside {};\n";
  EXPECT_EQ(classes_of(text), (std::vector<std::string>{"impinge::cli::Plain", "impinge::cli::Derived",
                                                        "impinge::cli::Generic", "impinge::cli::Kind", "Outside"}));
}

TEST(Names, OfClassesAreGivenOnce) {
  std::map<std::string, fs::path> places;
  for (const char* folder : {"include", "src", "io", "report", "cli", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      std::ifstream stream(entry.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      SCOPED_TRACE(entry.path());
      for (const std::string& name : classes_of(text)) {
        const auto [other, is_new] = places.emplace(name, entry.path());
        EXPECT_TRUE(is_new || other->second == entry.path()) << name << " is in " << other->second << " too";
      }
    }
  EXPECT_GT(places.size(), 300U);  // the reader of classes works
}

}  // namespace
