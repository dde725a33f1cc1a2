// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// One class, one name: of two that have the same name in one namespace the linker keeps one set of members for both.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path kSource = IMPINGE_SOURCE_DIR;

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
  for (const char* folder : {"include", "src", "io", "report", "cli", "python"}) {
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
  }
  EXPECT_GT(places.size(), 300U);  // the reader of classes works
}

}  // namespace
